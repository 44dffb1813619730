// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_compute_periods_h
#define crevasse_simulation_compute_periods_h

#include <crevasse/simulation/workspace.h>
#include <crevasse/time/observer.h>

namespace Crevasse
{
  /**
   * Computes periods until the stress is periodic, no more are allowed, or the
   * stage on this mesh ends. A motion that was found by harmonic balance is
   * verified and shown; otherwise the periods are marched or accelerated.
   *
   * @param work whose state is that at the beginning; afterwards result and
   * strain of the state are those after the last period, and so is the
   * displacement unless the run ends.
   * @throw NumericalError if a step fails, or if the motion that was found is
   * not a solution and no other method may take over.
   */
  template <int dim>
  void
  compute_periods(Workspace<dim>                &work,
                  const std::vector<Observer *> &observers);
} // namespace Crevasse

#endif
