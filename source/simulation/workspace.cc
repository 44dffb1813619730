// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/simulation/workspace.h>

#include <iostream>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  Workspace<dim>::Workspace(const RunSetup<dim> &setup, Log &log)
    // Of this rank alone: with a communicator it would talk while an exception
    // is on its way.
    : phases(std::cout, TimerOutput::never, TimerOutput::wall_times)
    , steps(setup.steps)
    , integrator(setup.make_integrator())
    , step_control(setup.make_step_control())
    , systems(setup.scene,
              setup.body,
              setup.solvers,
              steps,
              setup.largest_nodal_force,
              log,
              phases)
    , evolution(setup.body.strain_operator,
                setup.body.points,
                setup.body.loads,
                systems)
    , start{setup.periodic_choice, setup.secular_split, {}, {}, {}}
  {
  }



  template <int dim>
  RunState
  Workspace<dim>::add_to(RunState state) const
  {
    state.solvers = systems.statistics();
    state.rate_evaluations += evolution.n_rate_evaluations();
    for (const auto &[name, seconds] :
         phases.get_summary_data(TimerOutput::total_wall_time))
      state.seconds[name] += seconds;
    state.seconds["total"] += timer.wall_time();
    return state;
  }



  template struct Workspace<2>;
  template struct Workspace<3>;
} // namespace Crevasse
