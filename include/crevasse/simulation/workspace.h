// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_workspace_h
#define crevasse_simulation_workspace_h

#include <crevasse/checkpoint/checkpoints.h>
#include <crevasse/model/contact_system_cache.h>
#include <crevasse/periodic/run_state.h>
#include <crevasse/simulation/periodic_start.h>
#include <crevasse/time/evolution.h>

namespace Crevasse
{
  /** The outputs of a run. */
  struct RunOutput
  {
    Log              &log;
    Checkpoints      &checkpoints;
    const std::string directory;
    bool              stress_record; ///< whether StressWriter runs
  };

  /**
   * Objects of a run on one mesh: its set-up, outputs and state, and what
   * changes with time: its steps, integrator, and the systems that solve for
   * displacements.
   */
  template <int dim>
  struct Workspace
  {
    /** The arguments must outlive the Workspace. */
    Workspace(const RunSetup<dim> &setup,
              const RunOutput     &output,
              RunState            &state)
      : setup(setup)
      , output(output)
      , state(state)
      , steps(setup.steps)
      , integrator(setup.make_integrator())
      , step_control(setup.make_step_control())
      , systems(setup.scene,
                setup.body,
                setup.solvers,
                steps,
                setup.largest_nodal_force,
                output.log)
      , evolution(setup.body.strain_operator,
                  setup.body.points,
                  setup.body.loads,
                  systems,
                  setup.scene.time_integration.newton_tolerance)
      , start{setup.periodic_choice, setup.secular_split, {}, {}, {}}
    {
      systems.add(state.solvers);
    }

    const RunSetup<dim>         &setup;
    const RunOutput             &output;
    RunState                    &state;
    StepList                     steps; ///< adaptive steps change
    std::unique_ptr<Integrator>  integrator;
    std::unique_ptr<StepControl> step_control;
    ContactSystemCache<dim>      systems;
    Evolution<dim>               evolution;
    PeriodicStart                start;
  };
} // namespace Crevasse

#endif
