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

#include <crevasse/scene/period_mean.h>

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <limits>

namespace Crevasse
{
  double
  period_mean(const std::function<double(const double t)> &f,
              const double                                 period)
  {
    constexpr unsigned int coarsest = 128, finest = 8192;
    constexpr double rounding = 8. * std::numeric_limits<double>::epsilon();

    // Away from the instants that formulas like, such as fractions of T.
    constexpr double offset = 0.309016994374947;

    double sum = 0., largest = 0.;
    for (unsigned int k = 0; k < coarsest; ++k)
      {
        const double value = f(period * (k + offset) / coarsest);
        sum += value;
        largest = std::max(largest, std::abs(value));
      }
    // Equal steps are blind to the harmonics that they divide: two refinements
    // have to agree, so that only multiples of 512 could deceive.
    unsigned int agreements = 0;
    double       mean       = sum / coarsest;
    for (unsigned int n = coarsest; n < finest; n *= 2)
      {
        for (unsigned int k = 0; k < n; ++k)
          {
            const double x     = (k + 0.5) / n + offset / coarsest;
            const double value = f(period * (x < 1. ? x : x - 1.));
            sum += value;
            largest = std::max(largest, std::abs(value));
          }
        const double finer = sum / (2. * n);
        agreements =
          std::abs(finer - mean) <= rounding * largest ? agreements + 1 : 0;
        mean = finer;
        if (agreements == 2)
          return mean;
      }
    constexpr unsigned int most_bisections = 50;
    constexpr double       tolerance       = 1e-13;
    return boost::math::quadrature::gauss_kronrod<double, 15>::integrate(
             f, 0., period, most_bisections, tolerance) /
           period;
  }
} // namespace Crevasse
