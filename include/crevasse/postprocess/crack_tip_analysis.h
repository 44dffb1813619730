// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_crack_tip_analysis_h
#define crevasse_postprocess_crack_tip_analysis_h

#include <crevasse/base/log.h>
#include <crevasse/base/summary.h>
#include <crevasse/crack_tip/nested_fits.h>
#include <crevasse/crack_tip/strain_energy.h>
#include <crevasse/model/contact_system_cache.h>
#include <crevasse/model/secular_problem.h>
#include <crevasse/postprocess/crack_tip_choice.h>
#include <crevasse/postprocess/crack_tip_table.h>

#include <memory>
#include <optional>
#include <string>

namespace Crevasse
{
  /** All that is read off at the crack tip of one run. */
  class CrackTipAnalysis
  {
  public:
    /** Finds what is wrong with the tip, before anything is computed.
     * Collective. Arguments must outlive this object.
     * @throw SceneError */
    CrackTipAnalysis(const Scene        &scene,
                     const Body<2>      &body,
                     const SecularSplit &split,
                     const StepList     &steps);

    /** One line for the log. */
    std::string
    describe() const;

    /** The observer of a run, which in the end adds "crack_tip" to the summary
     * and prints a few lines. Solves for the weight functions. References must
     * outlive the table.
     *
     * @param flow none: none was found. */
    std::unique_ptr<CrackTipTable>
    make_table(ContactSystemCache<2>            &systems,
               const StepList                   &steps,
               const std::optional<SecularFlow> &flow,
               const CrackTipTable::File        &file,
               Log                              &log) const;

  private:
    friend class CrackTipTable;

    void
    summarise(const CrackTipTable &table,
              const SecularFlow   *flow,
              Summary             &summary,
              Log                 &log) const;

    /** Of the elastic body at the extreme loads, in the cells of the tip: what
     * the mesh leaves. */
    double
    relative_energy_error(ContactSystemCache<2> &systems,
                          const StepList        &steps) const;

    /** @throw SceneError if a point support at the tip has to bear loads. */
    void
    require_no_force_at_tip(const StepList &steps) const;

    double
    choose_radius() const;
    double
    choose_fit_radius() const;

    /** Of the square where the body creeps everywhere alike: there the stress
     * is Williams' series whatever the rest of the body does; 0: none. */
    double
    homogeneous_radius() const;

    /** What hinders C* from being known; empty: nothing. Makes the region of
     * the viscosity. */
    std::string
    find_viscous_region(const SecularSplit &split);

    /** C* = K²/E'_η with the K of the mean stress, which is η times the strain
     * rate of the flow. */
    std::optional<double>
    c_star(const SecularFlow *flow) const;

    /** @param energy the largest strain energy of the history. */
    void
    warn_of_uncertainty(const TipHistory &history,
                        const double      error,
                        const double      energy,
                        Summary          &summary,
                        Log              &log) const;

    /** E' = 8μ/(κ + 1) at an instant within the period. */
    double
    modulus(const double t) const;

    const Scene                   &scene;
    const Body<2>                 &body;
    const PointGeometry            points;
    const CrackTipChoice           choice;
    const TipRegion                region;
    const double                   radius; ///< of the integral
    const NestedFits               fits;
    const StrainEnergy             energy;
    const std::string              growth_law; ///< its description; empty: none
    std::optional<const TipRegion> viscous_region;
    const std::string              no_c_star; ///< why; empty: known
    const bool                     mean_load_vanishes;
  };
} // namespace Crevasse

#endif
