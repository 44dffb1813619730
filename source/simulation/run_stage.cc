// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/simulation/compute_periods.h>
#include <crevasse/simulation/conclusion.h>
#include <crevasse/simulation/observers.h>
#include <crevasse/simulation/relaxation_table.h>
#include <crevasse/simulation/run_stage.h>

#include <memory>

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
    Workspace<dim> work(setup, output, state);
    const bool     any_periods = scene.periodic_state.maximum_periods > 0;
    output.checkpoints.requests().stop_if_asked();
    if (any_periods)
      find_periodic_start(work);
    if (!scene.contact.relaxation_table.empty() && !state.has_tables())
      write_relaxation_table(work);
    // Where nothing is marched, no tables are begun either.
    std::vector<std::unique_ptr<Observer>> observers;
    state.stage.ends_run = true;
    if (any_periods)
      {
        observers = make_observers(work);
        std::vector<Observer *> all;
        for (const auto &observer : observers)
          all.push_back(observer.get());
        all.insert(all.end(), others.begin(), others.end());
        compute_periods(work, all);
      }
    if (state.stage.ends_run)
      {
        summarise_run(work, summary);
        for (const auto &observer : observers)
          observer->summarise(summary);
      }
    state = work.state_so_far();
    if (!state.stage.ends_run)
      return;
    write_summary(work, summary);
    conclude(work, summary);
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
