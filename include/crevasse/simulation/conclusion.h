// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_conclusion_h
#define crevasse_simulation_conclusion_h

#include <crevasse/base/problems.h>
#include <crevasse/base/summary.h>
#include <crevasse/simulation/workspace.h>

namespace Crevasse
{
  /** Error: stress is not periodic after the maximum of periods. All results
   * are written, but they are not periodic as requested. */
  struct NotPeriodicError : NumericalError
  {
    using NumericalError::NumericalError;
  };

  /** Summarises what was computed and how: versions, sizes, effects, choices,
   * warnings, counters and certificate. Logs the last two. Collective. */
  template <int dim>
  void
  summarise_run(const Workspace<dim> &work, Summary &summary);

  /** Adds results and cost of the periods to the summary, and writes it.
   * Collective. @throw FileError */
  template <int dim>
  void
  write_summary(const Workspace<dim> &work, Summary &summary);

  /**
   * Checks that the results of a run, which are written, are as requested.
   * Collective.
   *
   * @param summary of the whole run.
   * @throw NumericalError if the stress is only rounding; NotPeriodicError if
   * the periodic state was not reached, if the mean force on the lip differs
   * from the secular problem, or if the lip closes further in the last period.
   */
  template <int dim>
  void
  conclude(const Workspace<dim> &work, const Summary &summary);
} // namespace Crevasse

#endif
