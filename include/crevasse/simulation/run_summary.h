// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_run_summary_h
#define crevasse_simulation_run_summary_h

#include <crevasse/simulation/workspace.h>

namespace Crevasse
{
  /** What was computed and how: versions, sizes, effects, choices, warnings,
   * counters and certificate. Prints the last two. Collective.
   *
   * @param state with what was counted before this stage. */
  template <int dim>
  void
  summarise_run(const RunSetup<dim>  &setup,
                const Workspace<dim> &work,
                const RunState       &state,
                Log                  &log,
                Summary              &summary);

  /** summary.json "secular": the flow that is split off, or was measured as
   * drift. Collective. */
  template <int dim>
  void
  summarise_secular_flow(const RunSetup<dim> &setup,
                         const PeriodicStart &start,
                         Summary             &summary);

  /** Adds what the periods have come to, and what it took, and writes all of
   * it. Collective. @throw FileError */
  void
  write_summary(const RunState  &state,
                const MPI_Comm   communicator,
                const RunOutput &output,
                Summary         &summary);
} // namespace Crevasse

#endif
