// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_conclusion_h
#define crevasse_simulation_conclusion_h

#include <crevasse/base/log.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/summary.h>
#include <crevasse/periodic/observed_periods.h>
#include <crevasse/simulation/periodic_start.h>
#include <crevasse/simulation/run_setup.h>

namespace Crevasse
{
  /** The stress is not periodic after the last period allowed: all results are
   * written, but they are not what was asked for. */
  struct NotPeriodicError : NumericalError
  {
    using NumericalError::NumericalError;
  };

  /**
   * Whether the results of a run, all of which are written, are what was asked
   * for. Collective.
   *
   * @param summary of the whole run.
   * @param can_resume whether there is a checkpoint to resume from.
   * @throw NumericalError if the stress is nothing but rounding;
   * NotPeriodicError if the periodic state was not reached, if the lip bears
   * another mean force than the secular problem has, or if the lip still closes
   * over the last period, which no periodic state does. */
  template <int dim>
  void
  conclude(const RunSetup<dim>  &setup,
           const PeriodicStart  &start,
           const PeriodicResult &result,
           const Summary        &summary,
           const bool            can_resume,
           Log                  &log);
} // namespace Crevasse

#endif
