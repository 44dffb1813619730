// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_relaxation_table_h
#define crevasse_simulation_relaxation_table_h

#include <crevasse/simulation/workspace.h>

namespace Crevasse
{
  /**
   * Logs the paper's Table 1 and writes it to relaxation.csv: without
   * constraints, at the instant of the largest load, the number of SOR
   * iterations to the residual of the direct solver, for each relaxation factor
   * of the scene and for the best factor, found by dichotomy.
   *
   * The paper's machine is assumed to have single precision with 27 bits of
   * mantissa: its direct solver's residual then is that of a solution rounded
   * to 27 bits, the target of the table's second column.
   */
  template <int dim>
  void
  write_relaxation_table(Workspace<dim> &work);
} // namespace Crevasse

#endif
