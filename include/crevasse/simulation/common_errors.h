// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_common_errors_h
#define crevasse_simulation_common_errors_h

#include <crevasse/simulation/run.h>

namespace Crevasse
{
  /** An error that runs on other meshes, or with other steps, have in common,
   * so that their differences do not show it. */
  struct CommonError
  {
    std::string part;    ///< of error bars, that has no limit: "mesh" or "time"
    std::string why;     ///< in a few words
    std::string warning; ///< what is wrong and what to try
  };

  /** Locking, materials that jump within cells, and loads between steps.
   * Collective. */
  template <int dim>
  std::vector<CommonError>
  common_errors(const Run<dim> &run);

  /** Tables over time with peaks that the current steps miss. */
  template <int dim>
  std::vector<CommonError>
  missed_rows(const Run<dim> &run);
} // namespace Crevasse

#endif
