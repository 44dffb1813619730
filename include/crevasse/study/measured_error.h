// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_study_measured_error_h
#define crevasse_study_measured_error_h

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace Crevasse
{
  /** Positions of the instants that two ascending lists have in common. */
  struct CommonInstants
  {
    /** @param period Instants are the same if they differ by less than 1e-9 of
     * it. */
    CommonInstants(const std::vector<double> &one,
                   const std::vector<double> &other,
                   const double               period);

    std::vector<std::pair<std::size_t, std::size_t>> pairs;

    /** Why a comparison at these instants says nothing; empty if it does: at
     * rest all runs agree, and a few instants at which the load is zero may be
     * all that adaptive steps have in common with others. */
    std::string objection;
  };

  /** Largest difference and value while columns are compared. */
  struct Extremes
  {
    double difference = 0.;
    double size       = 0.; ///< of the reference
    bool   finite     = true;

    void
    add(const double value, const double reference);
  };

  /** A largest difference over a largest value, or why there is none. */
  struct MeasuredError
  {
    std::optional<double> value;
    std::size_t           instants = 0; ///< that both have
    std::string           reason;       ///< if there is no value

    /** @param extremes differences at common instants, values of the reference
     * at any. */
    static MeasuredError
    relative(const Extremes &extremes, const std::size_t instants);

    static MeasuredError
    none(const std::string &reason, const std::size_t instants = 0);
  };
} // namespace Crevasse

#endif
