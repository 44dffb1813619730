// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/temperature/temperature_file.h>

#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  void
  refuse_temperature(const std::string &file_name, const std::string &reason)
  {
    throw SceneError("[Loads] Temperature = " + file_name + ": " + reason);
  }



  template <int dim>
  void
  TemperatureFile<dim>::set_instants(std::vector<double> new_instants)
  {
    instants = std::move(new_instants);
    if (instants.front() < 0. || instants.back() > period)
      refuse_temperature(
        file_name,
        "its instants go from " + Text::from_number(instants.front()) + " to " +
          Text::from_number(instants.back()) +
          "; they must be within the period, from 0 to [Loads] Period = " +
          Text::from_number(period) + ".");
  }



  template <int dim>
  double
  TemperatureFile<dim>::value(const Point<dim> &point, const double t) const
  {
    // The last instant is followed by the first of the next period.
    const std::size_t next =
      std::upper_bound(instants.begin(), instants.end(), t) - instants.begin();
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



  template class TemperatureFile<2>;
  template class TemperatureFile<3>;
} // namespace Crevasse
