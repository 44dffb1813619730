// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/time/aligned_steps.h>

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  AlignedSteps::AlignedSteps(const double unit)
    : unit(unit)
  {
  }



  double
  AlignedSteps::next(const double t, const double last, const double wish) const
  {
    constexpr double rounding = 1e-9;
    const auto       begins   = [t](const double step) {
      const double number = t / step;
      return std::abs(number - std::round(number)) <= rounding * (1. + number);
    };
    // What something else ended, an event or the period, may have any length.
    const int of_last = std::floor(std::log2(last / unit) + rounding);
    const int lowest  = of_last - 3;
    const int highest = std::clamp(static_cast<int>(std::floor(
                                     std::log2(wish / unit) + rounding)),
                                   lowest,
                                   of_last + 3);
    for (int level = highest; level >= lowest; --level)
      if (begins(std::ldexp(unit, level)))
        return std::ldexp(unit, level);
    return std::ldexp(unit, highest);
  }
} // namespace Crevasse
