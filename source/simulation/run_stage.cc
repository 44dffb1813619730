// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/postprocess/relaxation_table.h>
#include <crevasse/simulation/compute_periods.h>
#include <crevasse/simulation/conclusion.h>
#include <crevasse/simulation/observers.h>
#include <crevasse/simulation/run_stage.h>
#include <crevasse/simulation/run_summary.h>

#include <utility>

namespace Crevasse
{
  template <int dim>
  void
  run_stage(const RunSetup<dim>           &setup,
            const RunOutput               &output,
            const std::vector<Observer *> &others,
            RunState                      &state,
            Summary                        summary)
  {
    const Scene   &scene = setup.scene;
    Workspace<dim> work(setup, output.log);
    work.systems.add(state.solvers);
    const bool any_periods = scene.periodic_state.maximum_periods > 0;
    output.checkpoints.requests().stop_if_asked();
    if (any_periods)
      work.start = find_periodic_start(setup, work.systems, output.log);
    if (!scene.contact.relaxation_table.empty() && !state.has_tables())
      write_relaxation_table(scene,
                             setup.body,
                             work.systems,
                             work.steps,
                             output.log,
                             output.directory);
    // Where nothing is marched, no tables are begun either.
    if (any_periods)
      {
        Observers<dim> observers(setup, work, output, state);
        output.checkpoints.set_tables(observers.tables());
        std::vector<Observer *> all = observers.list();
        all.insert(all.end(), others.begin(), others.end());
        compute_periods(setup, work, output, all, state);
        observers.export_state(state);
        if (state.stage.ends_run)
          {
            summarise_run(setup, work, state, output.log, summary);
            observers.summarise(summary);
            summarise_secular_flow(setup, work.start, summary);
          }
      }
    else
      {
        state.stage.ends_run = true;
        summarise_run(setup, work, state, output.log, summary);
      }
    state = work.add_to(std::move(state));
    if (!state.stage.ends_run)
      return;
    if (work.start.direct)
      work.start.direct->add_to(summary);
    // By which --resume tells whether they are of the scene that is asked for.
    if (output.checkpoints.is_on())
      summary["scene"] = output.checkpoints.scene();
    write_summary(state, setup.body.space.communicator(), output, summary);
    conclude(setup,
             work.start,
             state.result,
             summary,
             output.checkpoints.is_on(),
             output.log);
  }



  template void
  run_stage<2>(const RunSetup<2> &,
               const RunOutput &,
               const std::vector<Observer *> &,
               RunState &,
               Summary);
  template void
  run_stage<3>(const RunSetup<3> &,
               const RunOutput &,
               const std::vector<Observer *> &,
               RunState &,
               Summary);
} // namespace Crevasse
