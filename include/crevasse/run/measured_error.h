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

#ifndef crevasse_run_measured_error_h
#define crevasse_run_measured_error_h

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace Crevasse
{
  /** A largest difference over a largest value, or why there is none. */
  struct MeasuredError
  {
    std::optional<double> value;
    std::size_t           instants = 0; ///< that both have
    std::string           reason;       ///< if there is no value

    /** @param difference and @p size the largest ones at @p instants common
     * instants, of which some must be @p beyond_start: at rest all runs agree.
     */
    static MeasuredError
    relative(const double      difference,
             const double      size,
             const std::size_t instants,
             const bool        beyond_start);

    static MeasuredError
    none(const std::string &reason);
  };

  /** Positions of the instants that two ascending lists have in common. */
  std::vector<std::pair<std::size_t, std::size_t>>
  common_instants(const std::vector<double> &one,
                  const std::vector<double> &other,
                  const double               tolerance);
} // namespace Crevasse

#endif
