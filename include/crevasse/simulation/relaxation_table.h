// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_relaxation_table_h
#define crevasse_simulation_relaxation_table_h

#include <crevasse/simulation/workspace.h>

namespace Crevasse
{
  /**
   * The paper's Table 1: without constraints, at the instant of the largest
   * load, the iterations that SOR needs to reach the residual of the direct
   * solver, for each factor that the scene lists and for the best one, found
   * by dichotomy. Printed, and written to relaxation.csv.
   *
   * The single precision of the paper's machine is assumed to have had 27 bits
   * of mantissa: its direct solver's residual then is that of a solution
   * rounded to them, so the table has a second column with this target.
   */
  template <int dim>
  void
  write_relaxation_table(Workspace<dim> &work);
} // namespace Crevasse

#endif
