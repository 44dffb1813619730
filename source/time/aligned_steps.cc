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
