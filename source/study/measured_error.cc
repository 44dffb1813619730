// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/study/measured_error.h>

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  CommonInstants::CommonInstants(const std::vector<double> &one,
                                 const std::vector<double> &other,
                                 const double               period)
  {
    const double tolerance = 1e-9 * period;
    std::size_t  i = 0, j = 0;
    while (i < one.size() && j < other.size())
      if (std::abs(one[i] - other[j]) <= tolerance)
        pairs.emplace_back(i++, j++);
      else if (one[i] < other[j])
        ++i;
      else
        ++j;

    // One of so many, or so many a period.
    constexpr std::size_t part = 4, a_period = 10;
    if (pairs.empty() || one[pairs.back().first] <= tolerance)
      objection = "no instant in common with the reference but t = 0";
    else if (part * pairs.size() < std::min(one.size(), other.size()) &&
             pairs.size() < a_period * one[pairs.back().first] / period)
      objection =
        "only " + std::to_string(pairs.size()) + " of " +
        std::to_string(std::min(one.size(), other.size())) +
        " instants in common with the reference: take multiples of the number "
        "of steps, or name instants in [Time integration] Steps";
  }



  void
  Extremes::add(const double value, const double reference)
  {
    finite     = finite && std::isfinite(value) && std::isfinite(reference);
    difference = std::max(difference, std::abs(value - reference));
    size       = std::max(size, std::abs(reference));
  }



  MeasuredError
  MeasuredError::relative(const Extremes &extremes, const std::size_t instants)
  {
    MeasuredError error;
    error.instants = instants;
    if (!extremes.finite)
      error.reason = "there are values that are not finite";
    else if (extremes.size == 0.)
      error.reason = "the reference is 0 at all instants";
    else
      error.value = extremes.difference / extremes.size;
    return error;
  }



  MeasuredError
  MeasuredError::none(const std::string &reason, const std::size_t instants)
  {
    MeasuredError error;
    error.instants = instants;
    error.reason   = reason;
    return error;
  }
} // namespace Crevasse
