// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_series_extremes_h
#define crevasse_base_series_extremes_h

#include <vector>

namespace Crevasse
{
  /**
   * Least and largest value of a quantity over a period, from its values at
   * some instants. Between two of them it may be larger than at both:
   *
   * - where the quantity is smooth, by the parabola through three values, at
   *   most the straight extrapolations from both sides;
   * - where its curvature is four times that beside the interval, or more, it
   *   has a kink, as where contact switches or a load bends: by the
   *   intersection of the parabolas through the three values on either side,
   *   which rises at most twice as high as that of the lines. (A. Harten,
   *   J. Comput. Phys. 83, 1989, finds kinks likewise.)
   *
   * Errors are of second order in the step at least, also where the quantity is
   * only smooth on both sides of a kink. Instants that coincide up to a
   * thousandth of a step separate two smooth parts, such as values before and
   * after a jump, or around an instant at which a kink was found. Unknown
   * values (nan) do, too. If first and last value agree, the quantity is
   * continued periodically. An extreme has no sign that no value has, and is
   * one of the values if it differs from them by rounding.
   */
  class SeriesExtremes
  {
  public:
    /** @param instants ascending. @param values at the instants. */
    SeriesExtremes(const std::vector<double> &instants,
                   const std::vector<double> &values);

    struct Extreme
    {
      double value;
      double instant;
    };

    /** Extremes; nan without values. */
    Extreme least, largest;
  };
} // namespace Crevasse

#endif
