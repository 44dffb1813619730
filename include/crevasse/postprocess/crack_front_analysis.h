// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_crack_front_analysis_h
#define crevasse_postprocess_crack_front_analysis_h

#include <crevasse/crack_tip/front_integral.h>
#include <crevasse/secular/steady_creep.h>
#include <crevasse/time/step_list.h>

#include <optional>

namespace Crevasse
{
  /** Computes K_I along the crack fronts of a run in space, and K_II and K_III
   * for cracks with two lips; C* of its secular flow. */
  class CrackFrontAnalysis
  {
  public:
    /** Checks that the fronts have a K, before the run. Collective. The
     * arguments must outlive the CrackFrontAnalysis. @throw SceneError */
    CrackFrontAnalysis(const Scene        &scene,
                       const Body<3>      &body,
                       const SecularSplit &split,
                       const StepList     &steps);

    /** Describes the method in one line for the log. */
    std::string
    describe() const;

    /** K at a vertex of the front; the error is the difference between two
     * sizes of the tube. */
    struct Estimate
    {
      std::array<double, 3> intensity, error; ///< K of each mode in names()
      double                release_rate;
    };

    /** Estimates at all vertices. Collective. @param t within the period. */
    std::vector<Estimate>
    evaluate(const double t, const Sample &sample) const;

    /** A value at a vertex; the error is that of two sizes of the tube. */
    struct Value
    {
      double value, error;
    };

    /** C* at all vertices, the energy release rate of the flow with the
     * viscosity as stiffness, to which it is proportional where K is known.
     * None if there is no C*. Collective. */
    std::vector<Value>
    c_star(const std::optional<SecularFlow> &flow) const;

    /** Names of the computed modes: "K_I", … */
    std::vector<std::string>
    names() const
    {
      if (!region.curve.two_lips)
        return {"K_I"};
      return {"K_I", "K_II", "K_III"};
    }

    const Body<3>        &body;
    const FrontRegion     region;
    const double          radius;
    const FrontElasticity elasticity;
    const SteadyCreep<3>  creep;

  private:
    FrontElasticity
    find_elasticity() const;
    void
    require_compatible_creep(const VoigtMatrix<3> &stiffness) const;

    /** Whether K_I is 0 at each vertex, because the nearest node of the lips is
     * closed; see StressIntensity::Estimate. Collective. */
    std::vector<bool>
    stay_closed(const State &state) const;

    /** Common matrix of all points in the tube, if they agree. Collective. */
    std::optional<VoigtMatrix<3>>
    uniform_in_tube(const PointValues<VoigtMatrix<3>> &matrices) const;

    /** Integrals over the larger and the smaller tube, for each mode. */
    std::vector<std::pair<FrontIntegral, FrontIntegral>> integrals;
  };

  /** @param wanted_by the parameter that needs the stress at the front.
   * @throw SceneError if the loads need a support on a front. */
  void
  require_no_force_at_front(const Scene       &scene,
                            const Body<3>     &body,
                            const FrontRegion &region,
                            const StepList    &steps,
                            const std::string &wanted_by);
} // namespace Crevasse

#endif
