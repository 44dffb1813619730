// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/csv_file.h>
#include <crevasse/base/text.h>
#include <crevasse/parameters/growth_table.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Crevasse
{
  namespace
  {
    constexpr double outside  = std::numeric_limits<double>::quiet_NaN();
    constexpr double rounding = 1e-9;
  } // namespace



  GrowthTable::GrowthTable(const std::string &file_name)
  {
    const CsvFile file(file_name);
    file.demand(file.names == std::vector<std::string>{"Delta_K", "R", "da_dN"},
                "the columns must be Delta_K, R, da_dN");
    for (std::size_t k = 0; k < file.n_rows(); ++k)
      {
        const double range = file.columns[0][k], ratio = file.columns[1][k],
                     growth = file.columns[2][k];
        Curve &curve        = curves[ratio];
        file.demand(ratio < 1., "R must be less than 1", k);
        file.demand(range > 0. &&
                      (curve.ranges.empty() || range > curve.ranges.back()),
                    "Delta_K must be positive and ascend at each R",
                    k);
        file.demand(growth > 0. || (growth == 0. && curve.ranges.empty()),
                    "da_dN must be positive; only the first of an R may be 0, "
                    "at the threshold",
                    k);
        curve.ranges.push_back(range);
        curve.growth.push_back(growth);
      }
    file.demand(!curves.empty(), "there are no rows of numbers");
    for (const auto &[R, curve] : curves)
      file.demand(curve.ranges.size() > 1,
                  "there is one row for R = " + Text::from_number(R) +
                    "; each R needs at least two");
  }



  double
  GrowthTable::Curve::at(const double range) const
  {
    if (growth[0] == 0. && range <= ranges[0])
      return 0.;
    if (!(range >= ranges[0] * (1. - rounding) &&
          range <= ranges.back() * (1. + rounding)))
      return outside;
    const std::size_t k = std::clamp<std::size_t>(
      std::lower_bound(ranges.begin(), ranges.end(), range) - ranges.begin(),
      1,
      ranges.size() - 1);
    if (growth[k - 1] == 0.) // a logarithm has no threshold
      return growth[k] * (range - ranges[k - 1]) / (ranges[k] - ranges[k - 1]);
    const double part =
      std::log(range / ranges[k - 1]) / std::log(ranges[k] / ranges[k - 1]);
    return growth[k - 1] * std::pow(growth[k] / growth[k - 1], part);
  }



  double
  GrowthTable::growth(const double range, const double ratio) const
  {
    if (curves.size() == 1)
      return curves.begin()->second.at(range);
    const auto above = curves.lower_bound(ratio - rounding);
    if (above == curves.end())
      return outside;
    const double upper = above->second.at(range);
    if (std::abs(above->first - ratio) <= rounding)
      return upper;
    if (above == curves.begin())
      return outside;
    const auto  &below = *std::prev(above);
    const double lower = below.second.at(range);
    const double part  = (ratio - below.first) / (above->first - below.first);
    return (1. - part) * lower + part * upper;
  }
} // namespace Crevasse
