// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_crack_tip_analysis_h
#define crevasse_postprocess_crack_tip_analysis_h

#include <crevasse/crack_tip/growth_law.h>
#include <crevasse/crack_tip/strain_energy.h>
#include <crevasse/postprocess/stress_intensity.h>
#include <crevasse/secular/steady_creep.h>

namespace Crevasse
{
  /** All results at a crack tip of one run. */
  class CrackTipAnalysis
  {
  public:
    /** Checks the tip before the run. Collective. The arguments must outlive
     * the CrackTipAnalysis.
     * @throw SceneError */
    CrackTipAnalysis(const Scene                                &scene,
                     const Body<2>                              &body,
                     const CrackTip                             &tip,
                     const SecularSplit                         &split,
                     const StepList                             &steps,
                     const std::shared_ptr<const PointGeometry> &geometry);

    /** Describes the methods in one line for the log. */
    std::string
    describe() const;

    /** Rate C* = Σ K²/E'_η over the modes with the K of the mean stress, which
     * is η times the strain rate of the flow. */
    std::optional<double>
    c_star(const std::optional<SecularFlow> &flow) const;

    /** Temperature at the tip. @param t within the period. */
    double
    temperature(const double t) const
    {
      return body.temperature.value(intensity.region.tip.position, t);
    }

    /** Time G/C* in which a Maxwell body with a crack at rest comes to steady
     * creep, with the energy release rate G of the mean load (Riedel and Rice,
     * ASTM STP 700, 1980).
     * @param mean K_I and K_II of the mean load. */
    double
    transition_time(const std::array<double, 2> &mean,
                    const double                 c_star) const
    {
      return (mean[0] * mean[0] + mean[1] * mean[1]) /
             (body.law.stiffness_factor(0.) *
              intensity.elasticity(0.).modulus() * c_star);
    }

    /** K by the coefficient of the singular function with unit K in this mode;
     * 0 without has_singular_functions. Collective. */
    double
    of_singular_function(const CrackMode         mode,
                         const Vector           &displacement,
                         const MaterialState<2> &material) const;

    /** Adds C* and the growth of a history to the summary and the log.
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
    const bool            has_temperature; ///< whether it may differ from 0
    /** Whether the coefficients of singular functions are intensities. */
    const bool has_singular_functions;

  private:
    /** Finds the square with uniform viscosity, or why there is no C*. */
    void
    find_viscous_region();

    SteadyCreep<2>                    creep;
    std::optional<TipRegion::Uniform> viscous_region; ///< null without C*
  };

  /** @throw SceneError if the loads need a point support at the tip. */
  void
  require_no_force_at_tip(const Scene     &scene,
                          const Body<2>   &body,
                          const TipRegion &region,
                          const StepList  &steps);

  /** Analyses the tip of a half model, or each tip with two lips. Collective.
   * The arguments must outlive the result.
   * @param[out] without tips without K, each with the reason.
   * @throw SceneError */
  std::vector<std::unique_ptr<const CrackTipAnalysis>>
  analyse_crack_tips(const Scene          &scene,
                     const Body<2>        &body,
                     const SecularSplit   &split,
                     const StepList       &steps,
                     std::vector<Summary> &without);
} // namespace Crevasse

#endif
