// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/periodic/observed_periods.h>
#include <crevasse/time/evolution.h>

namespace Crevasse
{
  template <int dim>
  ObservedPeriods<dim>::ObservedPeriods(
    Evolution<dim>                &evolution,
    Integrator                    *integrator,
    StepList                      &steps,
    const std::vector<Observer *> &observers,
    Checkpointer                  &checkpointer,
    const SearchLimits            &limits)
    : evolution(evolution)
    , integrator(integrator)
    , steps(steps)
    , observers(observers)
    , writer(checkpointer)
    , limits(limits)
    , history(steps.period())
    , part(&checkpointer, [this](StateArchive &archive) { serialize(archive); })
  {
    evolution.repeat(steps);
  }



  template <int dim>
  std::size_t
  ObservedPeriods<dim>::n_solves() const
  {
    return evolution.statistics().vi_solves;
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
    archive.common(so_far.missions);
    archive.common(so_far.converged);
    archive.common(so_far.judged_error);
    archive.common(is_comparable);
    std::size_t solves = n_solves() - solves_before;
    archive.common(solves);
    double seconds = seconds_before + timer.wall_time();
    archive.common(seconds);
    bool replays = replay_from.size() > 0;
    archive.common(replays);
    if (replays)
      archive.at_points(replay_from);
    else
      history.serialize(archive);
    archive.at_points(r_before);
    if (defect != nullptr)
      {
        archive.nodal(u_before);
        archive.common(lip_opens);
        archive.common(so_far.return_defect);
      }
    for (Observer *observer : observers)
      observer->serialize(archive);
    if (archive.is_loading())
      {
        // The resumed run may have a smaller tolerance.
        if (so_far.converged)
          so_far.converged = is_within_tolerance(so_far.judged_error);
        solves_before  = n_solves() - solves;
        seconds_before = seconds;
        timer.restart();
      }
  }



  template <int dim>
  bool
  ObservedPeriods<dim>::begins_another(Vector &r)
  {
    const bool ends = is_over();
    // The start of the first period on another mesh cannot be reproduced, nor
    // can iterative solutions, which start from earlier ones, nor, to the last
    // digit, periods that do not begin where the one before ended.
    if (ends && has_memory() && !sums_increments &&
        evolution.repeats_exactly() && integrator->properties.repeats_steps &&
        std::isfinite(so_far.stress_change.back()))
      replay_from = r_before;
    if (has_memory())
      r_before = r;
    timer.restart();
    seconds_before = 0.;
    solves_before  = n_solves();
    first_step     = 0;
    ++so_far.periods;
    const SerializationScope here(checkpointer(), [&](StateArchive &archive) {
      serialize_step(archive, first_step, r);
    });
    if (ends)
      writer.at_end_of_search(so_far.periods, so_far.converged);
    else
      writer.between_steps(so_far.periods, first_step);
    --so_far.periods; // counts complete periods
    return first_step > 0 || !is_over();
  }



  template <int dim>
  void
  ObservedPeriods<dim>::serialize_step(StateArchive &archive,
                                       unsigned int &k,
                                       Vector       &r)
  {
    archive.section("period");
    archive.common(so_far.periods);
    archive.common(k);
    archive.at_points(r);
    evolution.serialize(archive);
    steps.serialize(archive);
    if (has_memory())
      integrator->serialize(archive);
  }



  template <int dim>
  void
  ObservedPeriods<dim>::advance(Vector &r)
  {
    unsigned int             k = first_step;
    const SerializationScope here(checkpointer(), [&](StateArchive &archive) {
      serialize_step(archive, k, r);
    });
    if (has_memory())
      rate.reinit(r, true);
    for (; k < steps.n_steps(); ++k)
      try
        {
          if (k > first_step &&
              (!has_memory() || !integrator->properties.controls_steps))
            writer.between_steps(so_far.periods, k);
          if (replay_from.size() > 0)
            replay();
          advance_step(k, r);
        }
      catch (const NumericalError &error)
        {
          throw NumericalError(Text::Message()
                               << "In period " << so_far.periods << ", step "
                               << k + 1 << " from t = " << steps.instant(k)
                               << " to " << steps.instant(k + 1) << ": "
                               << error.what());
        }
  }



  template <int dim>
  double
  ObservedPeriods<dim>::compute(Vector &r, const bool shows_end)
  {
    ++so_far.periods;
    if (sums_increments)
      {
        sum_of_steps.swap(r);
        if (first_step == 0)
          sum_of_steps = 0.;
        evolution.count_from(&r_before);
        advance(sum_of_steps);
        if (shows_end && !steps.jumps_at(steps.period()))
          end_before_jump(steps.n_steps(), sum_of_steps, true);
        evolution.count_from(nullptr);
        r = r_before;
        r += sum_of_steps;
      }
    else
      advance(r);
    return end_period(r);
  }



  template <int dim>
  void
  ObservedPeriods<dim>::replay()
  {
    const std::size_t solves = n_solves();
    Vector            r;
    r.swap(replay_from);
    for (unsigned int k = 0; k < steps.n_steps(); ++k)
      advance_step(k, r, false);
    history.take_change();
    solves_before += n_solves() - solves;
    timer.restart();
  }



  template <int dim>
  void
  ObservedPeriods<dim>::advance_step(const unsigned int k,
                                     Vector            &r,
                                     const bool         is_shown)
  {
    if (k == 0 && has_memory())
      integrator->begin_period();
    const double t = steps.instant(k);
    evolution.begin_step(t);
    if (has_memory())
      {
        // The rate at the end of the last step is from before the jump.
        if (steps.jumps_at(t))
          integrator->restart();
        integrator->start(evolution, t, r, rate);
      }
    else
      evolution.elastic_state(t);
    evolution.commit();

    const State &state = evolution.state();
    history.record(t, state.stress);
    if (defect != nullptr && k == 0 && is_shown)
      {
        lip_opens = u_before.size() > 0 &&
                    defect->lip_opens(u_before, state.displacement);
        u_before = state.displacement;
      }
    if (is_shown)
      show(sample(k, r));
    if (has_memory())
      integrator->advance({evolution, t, steps.step(k), rate, r});
    if (steps.jumps_at(steps.instant(k + 1)))
      end_before_jump(k + 1, r, is_shown);
  }



  template <int dim>
  void
  ObservedPeriods<dim>::end_before_jump(const unsigned int k,
                                        const Vector      &r,
                                        const bool         is_shown)
  {
    Sample end  = sample(k, r);
    end.instant = steps.just_before(end.instant);
    if (has_memory())
      evolution.rate(end.instant, r, rate);
    else
      evolution.elastic_state(end.instant);
    evolution.commit();
    history.record(end.instant, end.state.stress);
    if (is_shown)
      for (Observer *observer : observers)
        observer->before_jump(end);
  }



  template <int dim>
  Sample
  ObservedPeriods<dim>::sample(const unsigned int k, const Vector &r)
  {
    const bool   is_end       = k == steps.n_steps();
    const double t            = steps.instant(k);
    const bool   is_increment = evolution.counts_from_strain();
    if (is_increment)
      {
        shown_strain = r_before;
        shown_strain += r;
      }
    return {so_far.periods,
            k,
            is_end ? so_far.periods * steps.period()
                   : (so_far.periods - 1) * steps.period() + t,
            t,
            evolution.state(),
            is_increment ? shown_strain : r,
            evolution.right_hand_side(),
            evolution.secular_flow()};
  }



  template <int dim>
  double
  ObservedPeriods<dim>::end_period(const Vector &r)
  {
    double change       = history.take_change();
    so_far.steps_repeat = history.is_comparable();
    // A change needs enough common instants and a period on the same mesh.
    if (!so_far.steps_repeat || !is_comparable)
      change = std::numeric_limits<double>::quiet_NaN();
    is_comparable = true;
    so_far.stress_change.push_back(change);
    last = {so_far.periods,
            so_far.periods * steps.period(),
            change,
            0.,
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
  ObservedPeriods<dim>::rounding() const
  {
    return 10. * evolution.statistics().certificate.residual;
  }



  template <int dim>
  void
  ObservedPeriods<dim>::report(const double       error_estimate,
                               const unsigned int mission)
  {
    last.stress_error_estimate = error_estimate;
    last.mission               = mission;
    if (mission > 0)
      so_far.missions.push_back(mission);
    so_far.stress_error_estimate.push_back(error_estimate);
    so_far.judged_error = limits.quantity == nullptr
                            ? error_estimate
                            : limits.quantity->error(error_estimate);
    if (slip != nullptr && limits.quantity == nullptr &&
        std::isfinite(so_far.judged_error) &&
        !(slip->error() <= so_far.judged_error)) // nan counts
      so_far.judged_error = slip->error();
    last.judged_error = so_far.judged_error;
    so_far.converged  = is_within_tolerance(so_far.judged_error);
    for (Observer *observer : observers)
      observer->end_of_period(last);
  }



  template <int dim>
  void
  ObservedPeriods<dim>::finish(const Vector &r, const bool is_shown)
  {
    if (so_far.periods == 0)
      return;
    if (has_memory())
      {
        rate.reinit(r, true);
        evolution.rate(0., r, rate);
      }
    else
      evolution.elastic_state(0.);
    if (is_shown)
      show(sample(steps.n_steps(), r));
  }



  template class ObservedPeriods<2>;
  template class ObservedPeriods<3>;
} // namespace Crevasse
