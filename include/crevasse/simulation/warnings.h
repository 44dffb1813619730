// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_warnings_h
#define crevasse_simulation_warnings_h

#include <crevasse/simulation/run_setup.h>

namespace Crevasse
{
  /** Lines about settings that are valid, but probably a mistake.
   *
   * @param choice method by which the run finds its periodic state, and @p
   * split its flow: of the set-up, or what replaced them. */
  template <int dim>
  std::vector<std::string>
  warnings(const RunSetup<dim>  &setup,
           const PeriodicChoice &choice,
           const SecularSplit   &split);
} // namespace Crevasse

#endif
