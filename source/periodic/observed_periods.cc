// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/periodic/observed_periods.h>

#include <limits>

namespace Crevasse
{
  template <int dim>
  ObservedPeriods<dim>::ObservedPeriods(
    PeriodMap<dim>                &period_map,
    const SolveCount              &n_solves,
    const std::vector<Observer *> &observers,
    const unsigned int             maximum_periods,
    const PeriodicResult          &before,
    const bool                     is_comparable,
    const ReturnDefect<dim>       *defect)
    : period_map(period_map)
    , n_solves(n_solves)
    , observers(observers)
    , maximum_periods(maximum_periods)
    , is_comparable(is_comparable)
    , defect(defect)
    , history(period_map.steps().period())
    , so_far(before)
    , part(period_map.checkpointer(),
           [this](StateArchive &archive) { serialize(archive); })
  {
  }



  template <int dim>
  void
  ObservedPeriods<dim>::serialize(StateArchive &archive)
  {
    archive.section("periods");
    archive.common(so_far.periods);
    archive.common(so_far.steps_repeat);
    archive.common(so_far.stress_change);
    archive.common(so_far.stress_error_estimate);
    archive.common(is_comparable);
    std::size_t solves = n_solves() - solves_before;
    archive.common(solves);
    double seconds = seconds_before + timer.wall_time();
    archive.common(seconds);
    history.serialize(archive);
    if (defect != nullptr)
      {
        archive.at_points(r_before);
        archive.nodal(u_before);
        archive.common(lip_opens);
        archive.common(so_far.return_defect);
      }
    for (Observer *observer : observers)
      observer->serialize(archive);
    if (archive.is_loading())
      {
        solves_before  = n_solves() - solves;
        seconds_before = seconds;
        timer.restart();
      }
  }



  template <int dim>
  bool
  ObservedPeriods<dim>::may_go_on() const
  {
    return so_far.periods < maximum_periods;
  }



  template <int dim>
  bool
  ObservedPeriods<dim>::has_memory() const
  {
    return period_map.has_memory();
  }



  template <int dim>
  void
  ObservedPeriods<dim>::show(const Sample &sample)
  {
    for (Observer *observer : observers)
      observer->observe(sample);
  }



  template <int dim>
  void
  ObservedPeriods<dim>::begin_period(const Vector &r)
  {
    if (defect != nullptr)
      r_before = r;
    timer.restart();
    seconds_before = 0.;
    solves_before  = n_solves();
    ++so_far.periods;
  }



  template <int dim>
  void
  ObservedPeriods<dim>::stop_before(Vector &r)
  {
    begin_period(r);
    period_map.stop_before(so_far.periods, r);
    --so_far.periods;
  }



  template <int dim>
  double
  ObservedPeriods<dim>::compute(Vector &r)
  {
    begin_period(r);
    period_map.advance(so_far.periods, r, [this](const Sample &sample) {
      history.record(sample.instant, sample.state.stress);
      if (defect != nullptr && sample.step == 0)
        {
          const Vector &u = sample.state.displacement;
          lip_opens = u_before.size() > 0 && defect->lip_opens(u_before, u);
          u_before  = u;
        }
      show(sample);
    });

    double change       = history.take_change();
    so_far.steps_repeat = history.is_comparable();
    // Of a few instants it says nothing, and against none on this mesh either.
    if (!so_far.steps_repeat || !is_comparable)
      change = std::numeric_limits<double>::quiet_NaN();
    is_comparable = true;
    so_far.stress_change.push_back(change);
    last = {so_far.periods,
            so_far.periods * period_map.steps().period(),
            change,
            0.,
            history.largest_stress(),
            n_solves() - solves_before,
            seconds_before + timer.wall_time()};
    if (defect != nullptr)
      so_far.return_defect = ignores_drift && lip_opens
                               ? 0.
                               : (*defect)(r_before, r, last.largest_stress);
    return change;
  }



  template <int dim>
  double
  ObservedPeriods<dim>::return_defect() const
  {
    return so_far.return_defect;
  }



  template <int dim>
  void
  ObservedPeriods<dim>::ignore_drift_while_opening()
  {
    ignores_drift = true;
  }



  template <int dim>
  bool
  ObservedPeriods<dim>::strain_returns() const
  {
    return defect != nullptr;
  }



  template <int dim>
  void
  ObservedPeriods<dim>::report(const double error_estimate)
  {
    last.stress_error_estimate = error_estimate;
    so_far.stress_error_estimate.push_back(error_estimate);
    for (Observer *observer : observers)
      observer->end_of_period(last);
  }



  template <int dim>
  void
  ObservedPeriods<dim>::finish(const Vector &r)
  {
    if (so_far.periods > 0)
      period_map.finish(so_far.periods, r, [this](const Sample &sample) {
        show(sample);
      });
  }



  template <int dim>
  Checkpointer *
  ObservedPeriods<dim>::checkpointer() const
  {
    return period_map.checkpointer();
  }



  template <int dim>
  const PeriodicResult &
  ObservedPeriods<dim>::result() const
  {
    return so_far;
  }



  template class ObservedPeriods<2>;
  template class ObservedPeriods<3>;
} // namespace Crevasse
