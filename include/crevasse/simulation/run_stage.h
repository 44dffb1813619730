// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_run_stage_h
#define crevasse_simulation_run_stage_h

#include <crevasse/simulation/workspace.h>
#include <crevasse/time/observer.h>

#include <vector>

namespace Crevasse
{
  /**
   * Computes a run, or what of it is on one mesh, and writes everything to the
   * directory of @p output, which must exist; what is not known before the end
   * of the run only if this is it. Collective.
   *
   * @param others see what the tables see.
   * @param state The start, then the end.
   * @param summary that more is added to, and which is written.
   * @throw NumericalError; after all that was computed has been written if the
   * periodic state was not reached. */
  template <int dim>
  void
  run_stage(const RunSetup<dim>           &setup,
            const RunOutput               &output,
            const std::vector<Observer *> &others,
            RunState                      &state,
            Summary                        summary);
} // namespace Crevasse

#endif
