// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/state_archive.h>
#include <crevasse/simulation/adapted_mesh.h>
#include <crevasse/simulation/period_estimate.h>

namespace Crevasse
{
  template <int dim>
  PeriodEstimate<dim>::PeriodEstimate(const Scene       &scene,
                                      const Body<dim>   &body,
                                      const unsigned int period)
    : body(body)
    , period(period)
    , rounding(1e-12 * scene.loads.period)
    , stress_estimator(body.space, body.points, body.lip, scene.loads)
  {
    const StepList steps(scene.time_integration,
                         scene.loads.period,
                         scene.output.field_times);
    for (const double t : instants_of_estimate(scene, body, steps))
      instants.insert(steps.within_period(steps.instant(steps.nearest(t))));
  }



  template <int dim>
  void
  PeriodEstimate<dim>::observe(const Sample &sample)
  {
    // Adaptive steps may pass by an instant: then the next one is looked at.
    if (sample.period != period || instants.empty() ||
        sample.instant < *instants.begin() - rounding)
      return;
    while (!instants.empty() && sample.instant >= *instants.begin() - rounding)
      instants.erase(instants.begin());
    stress_estimator.look_at(sample.instant,
                             sample.state.stress,
                             sample.state.contact_forces,
                             body.material.at(sample.instant));
  }



  template <int dim>
  void
  PeriodEstimate<dim>::serialize(StateArchive &archive)
  {
    archive.section("estimate");
    archive.common(instants);
    stress_estimator.serialize(archive);
  }



  template <int dim>
  const StressEstimator<dim> &
  PeriodEstimate<dim>::estimator() const
  {
    return stress_estimator;
  }



  template class PeriodEstimate<2>;
  template class PeriodEstimate<3>;
} // namespace Crevasse
