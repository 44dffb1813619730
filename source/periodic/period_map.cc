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

#include <crevasse/periodic/period_map.h>

namespace Crevasse
{
  template <int dim>
  PeriodMap<dim>::PeriodMap(Evolution<dim> &evolution,
                            Integrator     *integrator,
                            const StepList &steps)
    : evolution(evolution)
    , integrator(integrator)
    , step_list(steps)
  {
  }



  template <int dim>
  void
  PeriodMap<dim>::advance(const unsigned int                         period,
                          Vector                                    &r,
                          const std::function<void(const Sample &)> &observe)
  {
    const RateFunction f = [&](const double t, const Vector &y, Vector &rate) {
      evolution.rate(step_list.within_period(t), y, rate);
    };
    for (unsigned int k = 0; k < step_list.n_steps(); ++k)
      {
        const double t    = step_list.instant(k);
        const double time = (period - 1) * step_list.period() + t;
        const auto   show = [&]() {
          observe({period,
                   k,
                   time,
                   evolution.state(),
                   r,
                   evolution.right_hand_side(),
                   evolution.secular_flow()});
        };
        if (has_memory())
          integrator->step(f, t, step_list.step(k), r, show);
        else
          {
            evolution.elastic_state(t);
            show();
          }
      }
  }



  template <int dim>
  void
  PeriodMap<dim>::finish(const unsigned int                         period,
                         const Vector                              &r,
                         const std::function<void(const Sample &)> &observe)
  {
    if (has_memory())
      {
        unused_rate.reinit(r, true);
        evolution.rate(0., r, unused_rate);
      }
    else
      evolution.elastic_state(0.);
    observe({period,
             step_list.n_steps(),
             period * step_list.period(),
             evolution.state(),
             r,
             evolution.right_hand_side(),
             evolution.secular_flow()});
  }



  template <int dim>
  const StepList &
  PeriodMap<dim>::steps() const
  {
    return step_list;
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
