// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/table_function.h>

#include <algorithm>
#include <boost/math/interpolators/pchip.hpp>
#include <cmath>
#include <limits>

namespace Crevasse
{
  void
  TableFunction::make_monotone_cubic()
  {
    auto abscissas = x, ordinates = y;
    cubic = boost::math::interpolators::pchip<std::vector<double>>(
      std::move(abscissas), std::move(ordinates));
  }



  double
  TableFunction::operator()(double at) const
  {
    if (!std::isfinite(at))
      return std::numeric_limits<double>::quiet_NaN();
    const double span = x.back() - x.front();
    if (is_of_time())
      at -= span * std::floor((at - x.front()) / span);
    at = std::clamp(at, x.front(), x.back());
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
    Miss         worst;
    for (std::size_t i =
           std::upper_bound(x.begin(), x.end(), begin) - x.begin();
         i < x.size() && x[i] < end;
         ++i)
      {
        const double part       = (x[i] - begin) / (end - begin);
        const double difference = y[i] - (1. - part) * first - part * last;
        if (std::abs(difference) > worst.difference)
          worst = {x[i], std::abs(difference)};
      }
    return worst;
  }
} // namespace Crevasse
