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

#include <crevasse/run/measured_error.h>

#include <cmath>

namespace Crevasse
{
  MeasuredError
  MeasuredError::relative(const double      difference,
                          const double      size,
                          const std::size_t instants,
                          const bool        beyond_start)
  {
    MeasuredError error;
    error.instants = instants;
    if (!beyond_start)
      error.reason = "no instant in common with the reference but t = 0";
    else if (!std::isfinite(difference) || !std::isfinite(size))
      error.reason = "there are values that are not finite";
    else if (size == 0.)
      error.reason = "the reference is 0 at all common instants";
    else
      error.value = difference / size;
    return error;
  }



  MeasuredError
  MeasuredError::none(const std::string &reason)
  {
    MeasuredError error;
    error.reason = reason;
    return error;
  }



  std::vector<std::pair<std::size_t, std::size_t>>
  common_instants(const std::vector<double> &one,
                  const std::vector<double> &other,
                  const double               tolerance)
  {
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    std::size_t                                      i = 0, j = 0;
    while (i < one.size() && j < other.size())
      if (std::abs(one[i] - other[j]) <= tolerance)
        pairs.emplace_back(i++, j++);
      else if (one[i] < other[j])
        ++i;
      else
        ++j;
    return pairs;
  }
} // namespace Crevasse
