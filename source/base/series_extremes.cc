// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/series_extremes.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Crevasse
{
  namespace
  {
    constexpr double one_instant    = 1e-3;  ///< part of a neighbouring step
    constexpr double same_value     = 1e-3;  ///< part of the range
    constexpr double rounding       = 1e-12; ///< part of the range or the size
    constexpr double smooth_beside  = 0.25;  ///< part of the curvature
    constexpr double most_of_linear = 2.;    ///< height above the lines'



    /** A series that may be continued periodically, and its largest value
     * between two of its instants. */
    class Series
    {
    public:
      using Extreme = SeriesExtremes::Extreme;

      Series(const std::vector<double> &instants,
             const std::vector<double> &values,
             const double               size)
        : t(instants)
        , q(values)
      {
        const std::size_t n = t.size();
        if (n <= beside ||
            !(std::abs(q.back() - q.front()) <= same_value * size))
          return;
        const double        period = t.back() - t.front();
        std::vector<double> before_t, before_q;
        for (std::size_t k = n - 1 - beside; k < n - 1; ++k)
          {
            before_t.push_back(instants[k] - period);
            before_q.push_back(values[k]);
          }
        for (std::size_t k = 1; k <= beside; ++k)
          {
            t.push_back(instants[k] + period);
            q.push_back(values[k]);
          }
        t.insert(t.begin(), before_t.begin(), before_t.end());
        q.insert(q.begin(), before_q.begin(), before_q.end());
      }

      std::size_t
      size() const
      {
        return t.size();
      }

      /** Largest value between the i-th and the next instant; the larger of
       * their values if there is nothing to find between. */
      Extreme
      between(const std::size_t i) const
      {
        const Extreme at_ends =
          q[i] >= q[i + 1] ? Extreme{q[i], t[i]} : Extreme{q[i + 1], t[i + 1]};
        if (i == 0 || !is_smooth(i - 1, i + 2) ||
            !(slope(i - 1) > 0. && slope(i + 1) < 0.))
          return at_ends;
        if (has_kink(i))
          return at_kink(i, at_ends);
        // A parabola through a kink of a neighbouring interval means nothing.
        return has_kink(i - 1) || has_kink(i + 1) ? at_ends
                                                  : of_parabola(i, at_ends);
      }

    private:
      /** Values on either side of an interval that are used. */
      static constexpr std::size_t beside = 3;

      double
      slope(const std::size_t i) const
      {
        return (q[i + 1] - q[i]) / (t[i + 1] - t[i]);
      }

      /** Divided difference of second order around the i-th instant. */
      double
      curvature(const std::size_t i) const
      {
        return (slope(i) - slope(i - 1)) / (t[i + 1] - t[i - 1]);
      }

      /** Whether the values from first to last are known, and no two of their
       * instants coincide. */
      bool
      is_smooth(const std::size_t first, const std::size_t last) const
      {
        if (last >= t.size() || std::isnan(q[first]))
          return false;
        double shortest = std::numeric_limits<double>::max(), longest = 0.;
        for (std::size_t k = first; k < last; ++k)
          {
            if (std::isnan(q[k + 1]))
              return false;
            shortest = std::min(shortest, t[k + 1] - t[k]);
            longest  = std::max(longest, t[k + 1] - t[k]);
          }
        return shortest > one_instant * longest;
      }

      /** Whether the slope falls faster between the i-th and the next instant
       * than it varies beside them. The kink is between those two instants that
       * have more of its curvature than their neighbours. */
      bool
      has_kink(const std::size_t i) const
      {
        if (i < 2 || !is_smooth(i - 2, i + 3))
          return false;
        const double before = curvature(i - 1), here = curvature(i),
                     next = curvature(i + 1), after = curvature(i + 2);
        return next <= before && here <= after &&
               std::max(std::abs(before), std::abs(after)) <=
                 smooth_beside * std::max(std::abs(here), std::abs(next));
      }

      /** The parabola through the values k − 1, k, k + 1. */
      double
      parabola(const std::size_t k, const double x) const
      {
        return q[k] +
               (x - t[k]) * (slope(k - 1) + (x - t[k - 1]) * curvature(k));
      }

      /** The straight line from the k-th value on. */
      double
      line(const std::size_t k, const double slope, const double x) const
      {
        return q[k] + slope * (x - t[k]);
      }

      Extreme
      of_parabola(const std::size_t i, const Extreme &at_ends) const
      {
        const std::size_t k = q[i] >= q[i + 1] ? i : i + 1;
        if (curvature(k) >= 0.)
          return at_ends;
        const double x = 0.5 * (t[k - 1] + t[k] - slope(k - 1) / curvature(k));
        if (!(x > t[i] && x < t[i + 1]))
          return at_ends;
        const double value = std::min({parabola(k, x),
                                       line(i, slope(i - 1), x),
                                       line(i + 1, slope(i + 1), x)});
        return value > at_ends.value ? Extreme{value, x} : at_ends;
      }

      Extreme
      at_kink(const std::size_t i, const Extreme &at_ends) const
      {
        const double left = slope(i - 1), right = slope(i + 1);
        const double x =
          t[i] + (line(i + 1, right, t[i]) - q[i]) / (left - right);
        if (!(x > t[i] && x < t[i + 1]))
          return at_ends;
        const double of_lines   = line(i, left, x);
        const auto   difference = [&](const double at) {
          return parabola(i - 1, at) - parabola(i + 2, at);
        };
        if (!(difference(t[i]) < 0. && difference(t[i + 1]) > 0.))
          return at_ends; // the kink is at an instant
        double low = t[i], high = t[i + 1];
        for (unsigned int halvings = 0; halvings < 50; ++halvings)
          (difference(0.5 * (low + high)) < 0. ? low : high) =
            0.5 * (low + high);
        const double value =
          std::min(parabola(i - 1, low),
                   at_ends.value + most_of_linear * (of_lines - at_ends.value));
        return value > at_ends.value ? Extreme{value, low} : at_ends;
      }

      std::vector<double> t, q;
    };



    SeriesExtremes::Extreme
    find_largest(const std::vector<double> &t, const std::vector<double> &q)
    {
      constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
      SeriesExtremes::Extreme best{unknown, unknown};
      double                  least = unknown;
      for (std::size_t k = 0; k < t.size(); ++k)
        {
          if (!(q[k] <= best.value)) // also the first
            best =
              std::isnan(q[k]) ? best : SeriesExtremes::Extreme{q[k], t[k]};
          least = std::fmin(least, q[k]);
        }
      const double range = best.value - least;
      if (!(range > rounding * std::max(std::abs(best.value), std::abs(least))))
        return best;
      const SeriesExtremes::Extreme of_values = best;
      const Series                  series(t, q, range);
      for (std::size_t i = 0; i + 1 < series.size(); ++i)
        if (const auto found = series.between(i);
            found.value > best.value + rounding * range)
          best = found;
      if (of_values.value <= 0. && best.value > 0.)
        return of_values;
      // Before or after the period is where it repeats.
      const double period = t.back() - t.front();
      best.instant += period * ((best.instant < t.front() ? 1. : 0.) -
                                (best.instant > t.back() ? 1. : 0.));
      return best;
    }
  } // namespace



  SeriesExtremes::SeriesExtremes(const std::vector<double> &instants,
                                 const std::vector<double> &values)
    : largest(find_largest(instants, values))
  {
    std::vector<double> opposite;
    for (const double value : values)
      opposite.push_back(-value);
    least       = find_largest(instants, opposite);
    least.value = -least.value;
  }
} // namespace Crevasse
