// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_memory_report_h
#define crevasse_simulation_memory_report_h

#include <crevasse/base/log.h>
#include <crevasse/simulation/run_setup.h>

namespace Crevasse
{
  /** Prints how much memory a run needs at its peak, on the process that needs
   * most, by what needs it. Collective.
   * @throw SceneError if the processes on a machine need more than it has left,
   * with what would fit. */
  template <int dim>
  void
  report_memory(const RunSetup<dim> &setup, Log &log);
} // namespace Crevasse

#endif
