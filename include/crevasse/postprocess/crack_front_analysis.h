// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_crack_front_analysis_h
#define crevasse_postprocess_crack_front_analysis_h

#include <crevasse/crack_tip/front_integral.h>
#include <crevasse/time/step_list.h>

#include <optional>

namespace Crevasse
{
  /** K_I along the crack fronts of one run in space, and of cracks with two
   * lips K_II and K_III. */
  class CrackFrontAnalysis
  {
  public:
    /** Finds what is wrong with the fronts, before anything is computed.
     * Collective. Arguments must outlive this object.
     * @throw SceneError */
    CrackFrontAnalysis(const Scene    &scene,
                       const Body<3>  &body,
                       const StepList &steps);

    /** One line for the log. */
    std::string
    describe() const;

    /** At a vertex of the front; the error is the difference between two sizes
     * of the tube. */
    struct Estimate
    {
      std::array<double, 3> intensity, error; ///< of each of names()
      double                release_rate;
    };

    /** At all vertices. Collective. @param t within the period. */
    std::vector<Estimate>
    evaluate(const double t, const Sample &sample) const;

    /** "K_I", … */
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

  private:
    double
    choose_radius(const double wish) const;
    FrontElasticity
    find_elasticity() const;
    void
    require_compatible_creep(const VoigtMatrix<3> &stiffness) const;
    void
    require_no_force_at_front(const Scene &scene, const StepList &steps) const;

    /** By vertex, whether K_I is 0, as StressIntensity::stays_closed at a tip:
     * whether the nearest node of the lips is pressed. Collective. */
    std::vector<bool>
    stay_closed(const State &state) const;

    /** What the points in the tube share; none if they differ. Collective. */
    std::optional<VoigtMatrix<3>>
    uniform_in_tube(const PointValues<VoigtMatrix<3>> &matrices) const;

    /** Over the larger and the smaller tube, of each mode. */
    std::vector<std::pair<FrontIntegral, FrontIntegral>> integrals;
  };
} // namespace Crevasse

#endif
