// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/table_function.h>

// pchip.hpp takes isnan() from there.
#include <algorithm>
#include <boost/math/interpolators/pchip.hpp>
#include <cmath>
#include <limits>
#include <math.h>

namespace Crevasse
{
  namespace
  {
    /** Slope at the end of a monotone cubic, from the lengths h and the slopes
     * m of the last interval and the next: that of a parabola, limited as in
     * SciPy's PchipInterpolator. */
    double
    slope_at_end(const double h0,
                 const double h1,
                 const double m0,
                 const double m1)
    {
      const double slope = ((2. * h0 + h1) * m0 - h0 * m1) / (h0 + h1);
      if (slope * m0 <= 0.)
        return 0.;
      return m0 * m1 < 0. && std::abs(slope) > std::abs(3. * m0) ? 3. * m0
                                                                 : slope;
    }



    std::function<double(double)>
    make_monotone_cubic(std::vector<double> x,
                        std::vector<double> y,
                        const bool          is_periodic)
    {
      const std::size_t n = x.size();
      const auto length = [&x](const std::size_t i) { return x[i + 1] - x[i]; };
      const auto slope  = [&](const std::size_t i) {
        return (y[i + 1] - y[i]) / length(i);
      };
      double begin = slope_at_end(length(0), length(1), slope(0), slope(1));
      double end =
        slope_at_end(length(n - 2), length(n - 3), slope(n - 2), slope(n - 3));
      if (is_periodic)
        {
          // The neighbours are rows of the periods before and after.
          const double span = x.back() - x.front();
          const auto   next = std::make_pair(x[1] + span, y[1]);
          x.insert(x.begin(), x[n - 2] - span);
          y.insert(y.begin(), y[n - 2]);
          x.push_back(next.first);
          y.push_back(next.second);
        }
      return boost::math::interpolators::pchip<std::vector<double>>(
        std::move(x), std::move(y), begin, end);
    }
  } // namespace



  TableFunction::TableFunction(const std::string         &file,
                               const std::string         &quantity,
                               const std::vector<double> &x,
                               const std::vector<double> &y,
                               const bool                 is_monotone_cubic)
    : file(file)
    , quantity(quantity)
    , x(x)
    , y(y)
    , least(*std::min_element(y.begin(), y.end()))
    , largest(*std::max_element(y.begin(), y.end()))
  {
    if (is_monotone_cubic)
      cubic = make_monotone_cubic(x, y, is_of_time());
  }



  double
  TableFunction::operator()(double at) const
  {
    if (!std::isfinite(at))
      return std::numeric_limits<double>::quiet_NaN();
    const double span = x.back() - x.front();
    if (is_of_time())
      at -= span * std::floor((at - x.front()) / span);
    least_seen   = std::min(least_seen, at);
    largest_seen = std::max(largest_seen, at);
    at           = std::clamp(at, x.front(), x.back());
    if (cubic)
      return cubic(at);
    const std::size_t i = std::upper_bound(x.begin(), x.end(), at) - x.begin();
    return i == x.size() ? y.back()
                         : y[i - 1] + (at - x[i - 1]) / (x[i] - x[i - 1]) *
                                        (y[i] - y[i - 1]);
  }



  bool
  TableFunction::can_jump() const
  {
    return std::adjacent_find(x.begin(), x.end()) != x.end();
  }



  TableFunction::Miss
  TableFunction::missed_between(const double begin, const double end) const
  {
    const double first = (*this)(begin), last = (*this)(end);
    const double range = largest - least;
    Miss         worst;
    if (range <= 1e-12 * std::max(std::abs(least), std::abs(largest)))
      return worst; // rounding
    for (std::size_t i =
           std::upper_bound(x.begin(), x.end(), begin) - x.begin();
         i < x.size() && x[i] < end;
         ++i)
      {
        const double part = (x[i] - begin) / (end - begin);
        const double difference =
          std::abs(y[i] - (1. - part) * first - part * last) / range;
        if (difference > worst.difference)
          worst = {x[i], difference};
      }
    return worst;
  }
} // namespace Crevasse
