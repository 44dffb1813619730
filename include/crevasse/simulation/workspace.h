// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_workspace_h
#define crevasse_simulation_workspace_h

#include <crevasse/checkpoint/checkpoints.h>
#include <crevasse/model/contact_system_cache.h>
#include <crevasse/periodic/run_state.h>
#include <crevasse/simulation/periodic_start.h>
#include <crevasse/time/evolution.h>

#include <iostream>


namespace Crevasse
{
  /** Where a run writes to. */
  struct RunOutput
  {
    Log              &log;
    Checkpoints      &checkpoints;
    const std::string directory;
    bool              stress_record; ///< see StressWriter
  };

  /**
   * A run on one mesh: what it computes with, where it writes to, what it has
   * come to, and what changes meanwhile: its steps, what integrates over them,
   * and the systems that solve for the displacement.
   */
  template <int dim>
  struct Workspace
  {
    /** All arguments must outlive this object. */
    Workspace(const RunSetup<dim> &setup,
              const RunOutput     &output,
              RunState            &state)
      : setup(setup)
      , output(output)
      , state(state)
      // Of this rank alone: with a communicator it would talk while an
      // exception is on its way.
      , phases(std::cout,
               dealii::TimerOutput::never,
               dealii::TimerOutput::wall_times)
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

    /** The state of the run with what was counted and timed here. */
    RunState
    state_so_far() const
    {
      RunState so_far = state;
      so_far.solvers  = systems.statistics();
      so_far.rate_evaluations += evolution.n_rate_evaluations();
      for (const auto &[name, seconds] :
           phases.get_summary_data(dealii::TimerOutput::total_wall_time))
        so_far.seconds[name] += seconds;
      so_far.seconds["strain sweeps"] += evolution.sweep_seconds();
      so_far.seconds["total"] += timer.wall_time();
      return so_far;
    }

    const RunSetup<dim>         &setup;
    const RunOutput             &output;
    RunState                    &state;
    dealii::Timer                timer;
    dealii::TimerOutput          phases;
    StepList                     steps; ///< adaptive ones change
    std::unique_ptr<Integrator>  integrator;
    std::unique_ptr<StepControl> step_control;
    ContactSystemCache<dim>      systems;
    Evolution<dim>               evolution;
    PeriodicStart                start;
  };
} // namespace Crevasse

#endif
