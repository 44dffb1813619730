// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/periodic/period_map.h>

#include <sstream>

namespace Crevasse
{
  template <int dim>
  PeriodMap<dim>::PeriodMap(Evolution<dim> &evolution,
                            Integrator     *integrator,
                            StepControl    &step_control,
                            StepList       &steps,
                            Checkpointer   *checkpointer)
    : evolution(evolution)
    , integrator(integrator)
    , step_control(step_control)
    , step_list(steps)
    , checkpointing(checkpointer)
  {
    evolution.repeat(steps);
  }



  template <int dim>
  void
  PeriodMap<dim>::begin_period()
  {
    if (!has_memory())
      return;
    integrator->restart();
    step_control.begin_period(step_list);
  }



  template <int dim>
  void
  PeriodMap<dim>::serialize(StateArchive &archive,
                            unsigned int &period,
                            unsigned int &step,
                            Vector       &r)
  {
    archive.section("period");
    archive.common(period);
    archive.common(step);
    archive.at_points(r);
    evolution.serialize(archive);
    step_list.serialize(archive);
    step_control.serialize(archive);
    if (has_memory())
      integrator->serialize(archive);
  }



  template <int dim>
  void
  PeriodMap<dim>::stop_before(unsigned int period, Vector &r)
  {
    unsigned int             first = 0;
    const SerializationScope here(checkpointing, [&](StateArchive &archive) {
      serialize(archive, period, first, r);
    });
    if (checkpointing != nullptr)
      checkpointing->at_end_of_search(period);
  }



  template <int dim>
  void
  PeriodMap<dim>::pause(const unsigned int period, const unsigned int step)
  {
    const bool can_be_kept =
      step == 0 || !has_memory() || integrator->may_pause();
    if (checkpointing != nullptr && can_be_kept)
      checkpointing->between_steps(period, step);
  }



  template <int dim>
  void
  PeriodMap<dim>::advance(unsigned int                               period,
                          Vector                                    &r,
                          const std::function<void(const Sample &)> &observe)
  {
    unsigned int             k = 0;
    const SerializationScope here(checkpointing, [&](StateArchive &archive) {
      serialize(archive, period, k, r);
    });
    if (has_memory())
      rate.reinit(r, true);
    for (; k < step_list.n_steps(); ++k)
      try
        {
          pause(period, k);
          if (k == 0)
            begin_period();
          const double t = step_list.instant(k);
          evolution.begin_step(t);
          if (!has_memory())
            evolution.elastic_state(t);
          else
            {
              // The end of the last step was before the jump.
              if (step_list.jumps_at(t))
                integrator->restart();
              step_control.start(*integrator, evolution, step_list, k, r, rate);
            }
          observe(sample(period, k, r));
          if (has_memory())
            step_control.advance(*integrator, evolution, step_list, k, rate, r);
        }
      catch (const NumericalError &error)
        {
          std::ostringstream where;
          where << "In period " << period << ", step " << k + 1
                << " from t = " << step_list.instant(k) << " to "
                << step_list.instant(k + 1) << ": ";
          throw NumericalError(where.str() + error.what());
        }
  }



  template <int dim>
  Sample
  PeriodMap<dim>::sample(const unsigned int period,
                         const unsigned int k,
                         const Vector      &r) const
  {
    const bool   is_end = k == step_list.n_steps();
    const double t      = step_list.instant(k);
    return {period,
            k,
            is_end ? period * step_list.period()
                   : (period - 1) * step_list.period() + t,
            t,
            evolution.state(),
            r,
            evolution.right_hand_side(),
            evolution.secular_flow()};
  }



  template <int dim>
  void
  PeriodMap<dim>::finish(const unsigned int                         period,
                         const Vector                              &r,
                         const std::function<void(const Sample &)> &observe)
  {
    if (has_memory())
      evolution.rate(0., r, rate);
    else
      evolution.elastic_state(0.);
    observe(sample(period, step_list.n_steps(), r));
  }



  template <int dim>
  const StepList &
  PeriodMap<dim>::steps() const
  {
    return step_list;
  }



  template <int dim>
  Checkpointer *
  PeriodMap<dim>::checkpointer() const
  {
    return checkpointing;
  }



  template <int dim>
  bool
  PeriodMap<dim>::has_memory() const
  {
    return integrator != nullptr;
  }



  template class PeriodMap<2>;
  template class PeriodMap<3>;
} // namespace Crevasse
