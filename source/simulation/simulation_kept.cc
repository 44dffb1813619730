// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/simulation/simulation.h>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  unsigned int
  Simulation<dim>::n_kept_stresses() const
  {
    const unsigned int of_anderson =
      periodic_choice.method == PeriodicMethodType::anderson
        ? 2 * (scene.periodic_state.anderson_depth + 2)
        : 0;
    const unsigned int n_branches = body.law.branches().size();
    return steps.n_steps() + 4 + 5 * n_branches + of_anderson * n_branches;
  }



  template <int dim>
  unsigned int
  Simulation<dim>::last_period_of_search() const
  {
    return scene.periodic_state.tolerance > 0.
             ? scene.periodic_state.maximum_periods
             : 0;
  }



  template <int dim>
  void
  Simulation<dim>::serialize(const RunState       &state,
                             const Solvers<dim>   &solvers,
                             const Evolution<dim> &evolution,
                             StateArchive         &archive) const
  {
    RunState now         = state;
    now.solvers          = solvers.statistics();
    now.rate_evaluations = rate_evaluations + evolution.n_rate_evaluations();
    for (const auto &[name, seconds] :
         phases.get_summary_data(TimerOutput::total_wall_time))
      now.seconds[name] += seconds;
    now.seconds["total"] += timer.wall_time();
    now.serialize(archive);
  }



#define INSTANTIATE(dim)                                                   \
  template unsigned int Simulation<dim>::n_kept_stresses() const;          \
  template unsigned int Simulation<dim>::last_period_of_search() const;    \
  template void         Simulation<dim>::serialize(const RunState &,       \
                                           const Solvers<dim> &,   \
                                           const Evolution<dim> &, \
                                           StateArchive &) const

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
