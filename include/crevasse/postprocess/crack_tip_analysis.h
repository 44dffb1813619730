// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_crack_tip_analysis_h
#define crevasse_postprocess_crack_tip_analysis_h

#include <crevasse/crack_tip/growth_law.h>
#include <crevasse/crack_tip/strain_energy.h>
#include <crevasse/model/secular.h>
#include <crevasse/model/secular_problem.h>
#include <crevasse/postprocess/stress_intensity.h>

namespace Crevasse
{
  /** All that is read off at a crack tip of one run. */
  class CrackTipAnalysis
  {
  public:
    /** Finds what is wrong with the tip, before anything is computed.
     * Collective. Arguments must outlive this object.
     * @throw SceneError */
    CrackTipAnalysis(const Scene                                &scene,
                     const Body<2>                              &body,
                     const CrackTip                             &tip,
                     const SecularSplit                         &split,
                     const StepList                             &steps,
                     const std::shared_ptr<const PointGeometry> &geometry);

    /** One line for the log. */
    std::string
    describe() const;

    /** C* = Σ K²/E'_η over the modes with the K of the mean stress, which is η
     * times the strain rate of the flow. */
    std::optional<double>
    c_star(const std::optional<SecularFlow> &flow) const;

    /** Of the coefficient of the singular function with unit K in this mode; 0
     * without has_singular_functions. Collective. */
    double
    of_singular_function(const CrackMode         mode,
                         const Vector           &displacement,
                         const MaterialState<2> &material) const;

    /** Adds C* and what the growth law makes of a history, and prints them.
     * @param title of lines in the log. */
    void
    summarise_growth(const TipHistory  &history,
                     const std::string &title,
                     Summary           &tip,
                     Log               &log) const;

    const Scene          &scene;
    const Body<2>        &body;
    const StressIntensity intensity;
    const StrainEnergy    energy;
    /** Whether the coefficients of singular functions are intensities. */
    const bool  has_singular_functions;
    std::string no_c_star; ///< why; empty: it is known

  private:
    /** What hinders C* from being known; empty: nothing. Finds the square of
     * the viscosity. */
    std::string
    find_viscous_region(const SecularSplit &split);

    std::optional<Viscosity<2>>       viscosity;      ///< if there is a C*
    std::optional<TipRegion::Uniform> viscous_region; ///< likewise
    const bool                        mean_load_vanishes;
  };

  /** @throw SceneError if a point support at the tip has to bear loads. */
  void
  require_no_force_at_tip(const Scene     &scene,
                          const Body<2>   &body,
                          const TipRegion &region,
                          const StepList  &steps);

  /** The one tip of a half model, or each tip with two lips. Collective.
   * Arguments must outlive what is returned.
   * @param[out] without Tips without K, each with the reason.
   * @throw SceneError */
  std::vector<std::unique_ptr<const CrackTipAnalysis>>
  analyse_crack_tips(const Scene          &scene,
                     const Body<2>        &body,
                     const SecularSplit   &split,
                     const StepList       &steps,
                     std::vector<Summary> &without);
} // namespace Crevasse

#endif
