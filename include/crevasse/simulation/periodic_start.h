// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_periodic_start_h
#define crevasse_simulation_periodic_start_h

#include <crevasse/harmonic_balance/fourier_problem.h>
#include <crevasse/simulation/run_setup.h>

namespace Crevasse
{
  /** What a run knows of its periodic state before it computes a period. */
  struct PeriodicStart
  {
    PeriodicChoice               choice; ///< another one where one has failed
    SecularSplit                 split;
    std::optional<SecularFlow>   flow;   ///< none: not looked for, or not found
    std::optional<FourierResult> direct; ///< by harmonic balance
    std::vector<std::string>     warnings;
  };

  template <int dim>
  struct Workspace;

  /** Solves what is to be known: the motion by harmonic balance, or the
   * secular problem. Where one fails, and the run can do without, it does.
   * Collective.
   * @throw NumericalError where it cannot. */
  template <int dim>
  void
  find_periodic_start(Workspace<dim> &work);
} // namespace Crevasse

#endif
