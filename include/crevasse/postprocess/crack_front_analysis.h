// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_crack_front_analysis_h
#define crevasse_postprocess_crack_front_analysis_h

#include <crevasse/crack_tip/front_integral.h>
#include <crevasse/time/step_list.h>

#include <optional>

namespace Crevasse
{
  /** K_I along the crack fronts of one run in space. */
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
      double intensity, release_rate, error;
    };

    /** At all vertices. Collective. @param t within the period. */
    std::vector<Estimate>
    evaluate(const double t, const Sample &sample) const;

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

    /** What the points in the tube share; none if they differ. Collective. */
    std::optional<VoigtMatrix<3>>
    uniform_in_tube(const PointValues<VoigtMatrix<3>> &matrices) const;

    const FrontIntegral large, small;
  };
} // namespace Crevasse

#endif
