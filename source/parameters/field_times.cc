// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/parameters/field_times.h>

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  std::vector<double>
  FieldTimes::instants(const double period) const
  {
    std::vector<double> all_known = listed;
    for (unsigned int k = 0; k < n_equal; ++k)
      all_known.push_back(period * k / n_equal);
    return all_known;
  }



  FieldTimes
  parse_field_times(const std::string &text)
  {
    const SceneError wrong(
      "must be automatic, all, a number of equally spaced "
      "instants such as \"12 instants\", or numbers from 0 "
      "to the period, separated by commas");
    FieldTimes times;
    times.of_extremes = text == "automatic";
    times.all         = text == "all";
    if (times.of_extremes || times.all)
      return times;
    const std::string unit = " instants";
    if (const std::size_t end = text.find(unit);
        end != std::string::npos && end + unit.size() == text.size())
      {
        const double n = Text::to_number(text.substr(0, end)).value_or(0.);
        if (n < 1. || n > 1e6 || n != std::floor(n))
          throw wrong;
        times.n_equal = static_cast<unsigned int>(n);
        return times;
      }
    const auto numbers = Text::to_numbers(text);
    if (!numbers || std::any_of(numbers->begin(),
                                numbers->end(),
                                [](const double t) { return t < 0.; }))
      throw wrong;
    times.listed = *numbers;
    return times;
  }
} // namespace Crevasse
