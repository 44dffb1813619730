// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_period_estimate_h
#define crevasse_simulation_period_estimate_h

#include <crevasse/discretisation/stress_estimator.h>
#include <crevasse/model/body.h>
#include <crevasse/parameters/scene.h>
#include <crevasse/time/observer.h>
#include <crevasse/time/step_list.h>

#include <set>

namespace Crevasse
{
  /** Estimates the errors of the stress at chosen instants of one period. */
  template <int dim>
  class PeriodEstimate : public Observer
  {
  public:
    /** All arguments must outlive this object.
     * @param period that is looked at. */
    PeriodEstimate(const Scene       &scene,
                   const Body<dim>   &body,
                   const unsigned int period);

    void
    observe(const Sample &sample) override;

    void
    serialize(StateArchive &archive) override;

    const StressEstimator<dim> &
    estimator() const;

  private:
    const Body<dim>     &body;
    const unsigned int   period;
    const double         rounding; ///< of instants
    StressEstimator<dim> stress_estimator;
    std::set<double>     instants; ///< still to come
  };
} // namespace Crevasse

#endif
