// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/period_mean.h>

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <limits>
#include <queue>

namespace Crevasse
{
  namespace
  {
    using Function = std::function<double(const double t)>;



    /** Part of a period, with the integral over it and the integral's error. */
    struct Part
    {
      double error, begin, end, integral;

      Part(const Function &f, const double begin, const double end)
        : begin(begin)
        , end(end)
        , integral(boost::math::quadrature::gauss_kronrod<double, 15>::
                     integrate(f, begin, end, 0, 0., &error))
      {
      }

      bool
      operator<(const Part &other) const
      {
        return error < other.error;
      }
    };



    /** Mean over a period of a function with kinks and jumps: bisects where the
     * error is largest until only rounding is left, or nothing more is gained.
     *
     * @param sections Instants from 0 to the period.
     * @param rounding of the integral over a section. */
    double
    adaptive_mean(const Function         &f,
                  const std::set<double> &sections,
                  const double            period,
                  const double            rounding)
    {
      constexpr std::size_t most_parts = 200;
      double                sum        = 0.;
      for (auto end = std::next(sections.begin()); end != sections.end(); ++end)
        {
          std::priority_queue<Part> parts;
          parts.emplace(f, *std::prev(end), *end);
          while (parts.top().error > rounding && parts.size() < most_parts)
            {
              const double begin = parts.top().begin, end = parts.top().end;
              parts.pop();
              parts.emplace(f, begin, (begin + end) / 2.);
              parts.emplace(f, (begin + end) / 2., end);
            }
          for (; !parts.empty(); parts.pop())
            sum += parts.top().integral;
        }
      return sum / period;
    }
  } // namespace



  double
  period_mean(const std::function<double(const double t)> &f,
              const double                                 period,
              std::set<double>                             kinks)
  {
    constexpr unsigned int coarsest = 128, finest = 8192;
    constexpr double rounding = 8. * std::numeric_limits<double>::epsilon();

    // Offset that avoids instants where formulas jump, such as fractions of T.
    constexpr double offset = 0.309016994374947;

    double sum = 0., largest = 0.;
    for (unsigned int k = 0; k < coarsest; ++k)
      {
        const double value = f(period * (k + offset) / coarsest);
        sum += value;
        largest = std::max(largest, std::abs(value));
      }
    // Equal steps miss harmonics that are multiples of their number: two
    // refinements have to agree, so that only multiples of 512 remain.
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
    // Between near rows of a table, rounding of t is seen.
    const double part = kinks.empty() ? 1. / coarsest : 4.;
    for (unsigned int k = 0; k <= coarsest; ++k) // fewer may miss a pulse
      kinks.insert(period * k / coarsest);
    // Rounding may place the last row of a table beyond the period.
    kinks.erase(kinks.begin(), kinks.lower_bound(0.));
    kinks.erase(kinks.upper_bound(period), kinks.end());
    return adaptive_mean(f,
                         kinks,
                         period,
                         part * std::numeric_limits<double>::epsilon() *
                           largest * period);
  }
} // namespace Crevasse
