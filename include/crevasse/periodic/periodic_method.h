// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_periodic_method_h
#define crevasse_periodic_periodic_method_h

#include <crevasse/time/rate_equation.h>

namespace Crevasse
{
  /** How the search for the periodic state ended. */
  enum class ConvergenceStatus
  {
    converged,      ///< the estimated error is within the tolerance
    out_of_periods, ///< as many periods as allowed were computed
    stagnant        ///< more periods would not help
  };

  /** A way to find the viscous strain with which a period begins and ends. */
  class PeriodicMethod
  {
  public:
    virtual ~PeriodicMethod() = default;

    /** Starts from the viscous strain @p r at the beginning of a period, which
     * afterwards is that at the end of the last one computed. */
    virtual ConvergenceStatus
    run(Vector &r) = 0;
  };
} // namespace Crevasse

#endif
