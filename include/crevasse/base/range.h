// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_range_h
#define crevasse_base_range_h

namespace Crevasse
{
  /** The values that a quantity may have, and how to say it. */
  struct Range
  {
    double      least, most;
    const char *text;

    /** False for what is no number. */
    constexpr bool
    contains(const double value) const
    {
      return value >= least && value <= most;
    }
  };

  namespace Ranges
  {
    /** Products of four quantities, as the squares of norms hold, must be
     * numbers that a computer has. */
    constexpr double smallest = 1e-70, largest = 1e70;

    constexpr Range size = {smallest, largest, "must be from 1e-70 to 1e70"};
    constexpr Range positive   = {smallest,
                                  largest,
                                  "must be greater than 0, from 1e-70 to 1e70"};
    constexpr Range any_number = {-largest,
                                  largest,
                                  "must be from -1e70 to 1e70"};

    // Close to -1 the shear modulus is all there is, and rounding eats the
    // rest.
    constexpr double least_ratio   = -0.999;
    constexpr Range  elastic_ratio = {least_ratio,
                                      0.5 - 1e-15,
                                      "must be at least -0.999 and less than "
                                       "0.5"};
    constexpr Range  viscous_ratio = {least_ratio,
                                      0.5,
                                      "must be at least -0.999 and at most 0.5"};
  } // namespace Ranges
} // namespace Crevasse

#endif
