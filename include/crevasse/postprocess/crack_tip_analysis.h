// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_crack_tip_analysis_h
#define crevasse_postprocess_crack_tip_analysis_h

#include <crevasse/base/summary.h>
#include <crevasse/crack_tip/strain_energy.h>
#include <crevasse/model/secular.h>
#include <crevasse/model/secular_problem.h>
#include <crevasse/postprocess/crack_tip_table.h>


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
     * and prints a few lines. References must
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

    /** Of the elastic body at the extreme loads, in the cells around the tip
     * that touch no other material: what the mesh leaves. */
    double
    relative_energy_error(ContactSystemCache<2> &systems,
                          const StepList        &steps) const;

    /** @throw SceneError if a point support at the tip has to bear loads. */
    void
    require_no_force_at_tip(const StepList &steps) const;

    /** What hinders C* from being known; empty: nothing. Finds the square of
     * the viscosity. */
    std::string
    find_viscous_region(const SecularSplit &split);

    /** C* = K²/E'_η with the K of the mean stress, which is η times the strain
     * rate of the flow. */
    std::optional<double>
    c_star(const SecularFlow *flow) const;

    /** @param energy the largest strain energy of the last period. */
    void
    warn_of_uncertainty(const TipHistory &history,
                        const double      error,
                        const double      energy,
                        Summary          &summary,
                        Log              &log) const;

    const Scene                &scene;
    const Body<2>              &body;
    const StressIntensity       intensity;
    const StrainEnergy          energy;
    const std::string           growth_law; ///< its description; empty: none
    std::optional<Viscosity<2>> viscosity;  ///< if there is a C*
    std::optional<TipRegion::Uniform> viscous_region; ///< likewise
    const std::string                 no_c_star;      ///< why; empty: known
    const bool                        mean_load_vanishes;
  };
} // namespace Crevasse

#endif
