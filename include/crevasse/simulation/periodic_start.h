// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_periodic_start_h
#define crevasse_simulation_periodic_start_h

#include <crevasse/harmonic_balance/fourier_problem.h>
#include <crevasse/simulation/run_setup.h>

namespace Crevasse
{
  /** Knowledge of a run about its periodic state before the first period. */
  struct PeriodicStart
  {
    PeriodicChoice               choice; ///< choice, or its replacement
    SecularSplit                 split;
    std::optional<SecularFlow>   flow;   ///< none: not sought or not found
    std::optional<FourierResult> direct; ///< harmonic balance
    std::vector<std::string>     warnings;
  };

  template <int dim>
  struct Workspace;

  /** Solves harmonic balance or the secular problem. If a problem fails and the
   * run can do without its solution, it does. Collective.
   * @throw NumericalError if the run needs the solution. */
  template <int dim>
  void
  find_periodic_start(Workspace<dim> &work);
} // namespace Crevasse

#endif
