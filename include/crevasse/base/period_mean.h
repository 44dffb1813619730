// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_period_mean_h
#define crevasse_base_period_mean_h

#include <functional>
#include <set>

namespace Crevasse
{
  /**
   * Mean (1/T) ∫ f dt of a function over a period. The trapezoidal rule is
   * refined until it settles to rounding, which is fast for smooth periodic
   * functions; otherwise an adaptive Gauss–Kronrod rule is used.
   *
   * @param kinks Instants from 0 to T with kinks and jumps, if they are known.
   */
  double
  period_mean(const std::function<double(const double t)> &f,
              const double                                 period,
              std::set<double>                             kinks = {});
} // namespace Crevasse

#endif
