// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_compute_periods_h
#define crevasse_simulation_compute_periods_h

#include <crevasse/simulation/workspace.h>
#include <crevasse/time/observer.h>

namespace Crevasse
{
  /**
   * Computes periods until the stress is periodic, the maximum of periods is
   * reached, or the stage on this mesh ends. A motion found by harmonic balance
   * is verified and shown; otherwise periods are marched or accelerated.
   *
   * @param work with the initial state; afterwards with the result and strain
   * after the last period, and the displacement unless the run ends.
   * @throw NumericalError if a step fails, or if the motion found is not a
   * solution and no other method may replace it.
   */
  template <int dim>
  void
  compute_periods(Workspace<dim>                &work,
                  const std::vector<Observer *> &observers);
} // namespace Crevasse

#endif
