// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_period_estimate_h
#define crevasse_simulation_period_estimate_h

#include <crevasse/discretisation/stress_estimator.h>
#include <crevasse/simulation/adapted_mesh.h>
#include <crevasse/time/observer.h>

namespace Crevasse
{
  /** Estimates the errors of the stress at chosen instants of one period. */
  template <int dim>
  class PeriodEstimate : public Observer
  {
  public:
    /** The arguments must outlive the PeriodEstimate.
     * @param period whose errors are estimated. */
    PeriodEstimate(const Scene       &scene,
                   const Body<dim>   &body,
                   const StepList    &steps,
                   const unsigned int period)
      : estimator(body.space, body.points, body.lip, scene.loads)
      , body(body)
      , period(period)
      , rounding(1e-12 * scene.loads.period)
    {
      for (const double t : instants_of_estimate(scene, body, steps))
        instants.insert(steps.within_period(steps.instant(steps.nearest(t))));
    }

    void
    observe(const Sample &sample) override
    {
      if (sample.period != period)
        return;
      // Adaptive steps may pass an instant: then the next step is used.
      const auto next = instants.upper_bound(sample.instant + rounding);
      if (next == instants.begin())
        return;
      instants.erase(instants.begin(), next);
      estimator.look_at(sample.instant,
                        sample.state.stress,
                        sample.state.contact_forces,
                        body.material.at(sample.instant));
    }

    void
    serialize(StateArchive &archive) override
    {
      archive.section("estimate");
      archive.common(instants);
      estimator.serialize(archive);
    }

    StressEstimator<dim> estimator;

  private:
    const Body<dim>   &body;
    const unsigned int period;
    const double       rounding; ///< rounding of instants
    std::set<double>   instants; ///< instants still to come
  };
} // namespace Crevasse

#endif
