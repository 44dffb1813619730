// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_conclusion_h
#define crevasse_simulation_conclusion_h

#include <crevasse/base/problems.h>
#include <crevasse/base/summary.h>
#include <crevasse/simulation/workspace.h>

namespace Crevasse
{
  /** The stress is not periodic after the last period allowed: all results are
   * written, but they are not what was asked for. */
  struct NotPeriodicError : NumericalError
  {
    using NumericalError::NumericalError;
  };

  /** What was computed and how: versions, sizes, effects, choices, warnings,
   * counters and certificate. Prints the last two. Collective. */
  template <int dim>
  void
  summarise_run(const Workspace<dim> &work, Summary &summary);

  /** Adds what the periods have come to, and what it took, and writes all of
   * it. Collective. @throw FileError */
  template <int dim>
  void
  write_summary(const Workspace<dim> &work, Summary &summary);

  /**
   * Whether the results of a run, all of which are written, are what was asked
   * for. Collective.
   *
   * @param summary of the whole run.
   * @throw NumericalError if the stress is nothing but rounding;
   * NotPeriodicError if the periodic state was not reached, if the lip bears
   * another mean force than the secular problem has, or if the lip still closes
   * over the last period, which no periodic state does. */
  template <int dim>
  void
  conclude(const Workspace<dim> &work, const Summary &summary);
} // namespace Crevasse

#endif
