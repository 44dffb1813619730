// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/simulation/workspace.h>

#include <iostream>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  Workspace<dim>::Workspace(const RunSetup<dim> &setup,
                            const RunOutput     &output,
                            RunState            &state)
    : setup(setup)
    , output(output)
    , state(state)
    // Of this rank alone: with a communicator it would talk while an exception
    // is on its way.
    , phases(std::cout, TimerOutput::never, TimerOutput::wall_times)
    , steps(setup.steps)
    , integrator(setup.make_integrator())
    , step_control(setup.make_step_control())
    , systems(setup.scene,
              setup.body,
              setup.solvers,
              steps,
              setup.largest_nodal_force,
              output.log,
              phases)
    , evolution(setup.body.strain_operator,
                setup.body.points,
                setup.body.loads,
                systems)
    , start{setup.periodic_choice, setup.secular_split, {}, {}, {}}
  {
    systems.add(state.solvers);
  }



  template <int dim>
  RunState
  Workspace<dim>::state_so_far() const
  {
    RunState so_far = state;
    so_far.solvers  = systems.statistics();
    so_far.rate_evaluations += evolution.n_rate_evaluations();
    for (const auto &[name, seconds] :
         phases.get_summary_data(TimerOutput::total_wall_time))
      so_far.seconds[name] += seconds;
    so_far.seconds["strain sweeps"] += evolution.sweep_seconds();
    so_far.seconds["total"] += timer.wall_time();
    return so_far;
  }



  template struct Workspace<2>;
  template struct Workspace<3>;
} // namespace Crevasse
