// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#ifndef crevasse_periodic_march_h
#define crevasse_periodic_march_h

#include <crevasse/periodic/period_map.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace Crevasse
{
  /** How a search for the periodic state ended. */
  struct PeriodicResult
  {
    unsigned int periods   = 0;
    bool         converged = false;
    /** Whether the last two periods had (most of) their samples in common. */
    bool                steps_repeat = true;
    std::vector<double> stress_change; ///< one entry a period
  };

  /**
   * The paper's method (§6.2): integrate the Cauchy problem until the stress
   * of a period is that of the period before, at all samples.
   */
  template <int dim>
  class March
  {
  public:
    /** The number of variational inequalities solved so far. */
    using SolveCount = std::function<std::size_t()>;

    /** @param tolerance for the change of stress relative to its maximum; 0:
     * compute maximum_periods periods whatever the change. */
    March(PeriodMap<dim>    &period_map,
          const SolveCount  &n_solves,
          const double       tolerance,
          const unsigned int maximum_periods);

    /** Marches from the viscous strain @p r, which afterwards is that at the
     * end of the last period. */
    PeriodicResult
    run(Vector &r, const std::vector<Observer *> &observers);

  private:
    PeriodMap<dim>    &period_map;
    const SolveCount   n_solves;
    const double       tolerance;
    const unsigned int maximum_periods;
  };
} // namespace Crevasse

#endif
