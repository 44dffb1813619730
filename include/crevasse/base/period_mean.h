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

#ifndef crevasse_base_period_mean_h
#define crevasse_base_period_mean_h

#include <functional>

namespace Crevasse
{
  /**
   * (1/T) ∫ f dt over a period. The trapezoidal rule is refined until it
   * settles to rounding, which it does fast for smooth periodic functions; for
   * others an adaptive Gauss–Kronrod rule takes over.
   */
  double
  period_mean(const std::function<double(const double t)> &f,
              const double                                 period);
} // namespace Crevasse

#endif
