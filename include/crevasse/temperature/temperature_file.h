// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_temperature_temperature_file_h
#define crevasse_temperature_temperature_file_h

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>

#include <deal.II/base/point.h>

#include <algorithm>

namespace Crevasse
{
  /** Reports a wrong file of temperature. @throw SceneError */
  [[noreturn]] inline void
  refuse_temperature(const std::string &file_name, const std::string &reason)
  {
    throw SceneError("[Loads] Temperature = " + file_name + ": " + reason);
  }

  /**
   * Change of temperature given by a file at instants of the period: linear in
   * time between instants, and periodic. Derived classes interpolate in space.
   */
  template <int dim>
  class TemperatureFile
  {
  public:
    TemperatureFile(const std::string &file_name, const double period)
      : file_name(file_name)
      , period(period)
    {
    }

    virtual ~TemperatureFile() = default;

    /** Change of temperature. @throw SceneError outside grid or mesh. */
    double
    value(const dealii::Point<dim> &point, const double t) const
    {
      // The first instant of the next period follows the last instant.
      const std::size_t next =
        std::upper_bound(instants.begin(), instants.end(), t) -
        instants.begin();
      const std::size_t n      = instants.size();
      const std::size_t before = (next + n - 1) % n, after = next % n;
      const double      begin  = instants[before] - (next == 0 ? period : 0.);
      const double      end    = instants[after] + (next == n ? period : 0.);
      const double      weight = end > begin ? (t - begin) / (end - begin) : 0.;
      if (before == after || weight == 0.)
        return value_at_instant(point, before);
      return (1. - weight) * value_at_instant(point, before) +
             weight * value_at_instant(point, after);
    }

    std::size_t
    n_instants() const
    {
      return instants.size();
    }

  protected:
    /** Sets the instants, in ascending order. Derived classes must call this
     * first. @throw SceneError if one is outside the period. */
    void
    set_instants(std::vector<double> new_instants)
    {
      instants = std::move(new_instants);
      if (instants.front() < 0. || instants.back() > period)
        refuse_temperature(
          file_name,
          "its instants go from " + Text::from_number(instants.front()) +
            " to " + Text::from_number(instants.back()) +
            "; they must be within the period, from 0 to [Loads] Period = " +
            Text::from_number(period) + ".");
    }

    const std::string file_name;

  private:
    virtual double
    value_at_instant(const dealii::Point<dim> &point,
                     const std::size_t         instant) const = 0;

    const double        period;
    std::vector<double> instants;
  };
} // namespace Crevasse

#endif
