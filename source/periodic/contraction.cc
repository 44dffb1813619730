// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/periodic/contraction.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Crevasse
{
  double
  Contraction::add(const double change,
                   const bool   counts,
                   const double accuracy)
  {
    const double rounding = std::max(1e-10, accuracy);
    if (!counts || !std::isfinite(change))
      {
        last_change.reset();
        return std::numeric_limits<double>::quiet_NaN();
      }
    if (last_change && *last_change > rounding)
      {
        ratios.push_back(change / *last_change);
        if (ratios.size() > n_ratios)
          ratios.erase(ratios.begin());
      }
    last_change         = change;
    const double lambda = factor();
    if (change <= rounding)
      return lambda < 1.
               ? change * std::max(1., exponent * lambda / (1. - lambda))
               : change;
    return lambda < 1. ? exponent * change * lambda / (1. - lambda)
                       : std::numeric_limits<double>::quiet_NaN();
  }



  double
  slowness_of_relaxation(const double relaxed)
  {
    constexpr double least = 1e-4;
    return 1. / -std::expm1(-std::max(relaxed, least));
  }
} // namespace Crevasse
