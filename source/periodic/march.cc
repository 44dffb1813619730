// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#include <crevasse/periodic/march.h>
#include <crevasse/periodic/stress_history.h>

#include <deal.II/base/timer.h>

#include <limits>

namespace Crevasse
{
  namespace
  {
    double
    aitken_estimate(const std::vector<double> &changes)
    {
      if (changes.size() < 3)
        return std::numeric_limits<double>::quiet_NaN();
      const double last  = changes.back();
      const double ratio = last / changes[changes.size() - 2];
      return ratio < 1. ? last * ratio / (1. - ratio)
                        : std::numeric_limits<double>::quiet_NaN();
    }
  } // namespace



  template <int dim>
  March<dim>::March(PeriodMap<dim>    &period_map,
                    const SolveCount  &n_solves,
                    const double       tolerance,
                    const unsigned int maximum_periods)
    : period_map(period_map)
    , n_solves(n_solves)
    , tolerance(tolerance)
    , maximum_periods(maximum_periods)
  {
  }



  template <int dim>
  PeriodicResult
  March<dim>::run(Vector &r, const std::vector<Observer *> &observers)
  {
    const double  period = period_map.steps().period();
    StressHistory history(period);
    const auto    show = [&](const Sample &sample) {
      for (Observer *observer : observers)
        observer->observe(sample);
    };
    const auto record_and_show = [&](const Sample &sample) {
      history.record(sample.instant, sample.state.stress);
      show(sample);
    };

    PeriodicResult result;
    while (result.periods < maximum_periods && !result.converged)
      {
        dealii::Timer     timer;
        const std::size_t solves_before = n_solves();
        ++result.periods;
        period_map.advance(result.periods, r, record_and_show);

        double change       = history.take_change();
        result.steps_repeat = history.is_comparable();
        if (!result.steps_repeat) // of a few instants: it says nothing
          change = std::numeric_limits<double>::quiet_NaN();
        result.stress_change.push_back(change);
        result.converged =
          !period_map.has_memory() || (tolerance > 0. && change <= tolerance);
        const PeriodReport report{result.periods,
                                  result.periods * period,
                                  change,
                                  aitken_estimate(result.stress_change),
                                  history.largest_stress(),
                                  n_solves() - solves_before,
                                  timer.wall_time()};
        for (Observer *observer : observers)
          observer->end_of_period(report);
      }
    if (result.periods > 0)
      period_map.finish(result.periods, r, show);
    return result;
  }



  template class March<2>;
  template class March<3>;
} // namespace Crevasse
