// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/parameters/chain.h>

namespace Crevasse
{
  std::vector<ChainBranch>
  parse_chain(const std::string &text)
  {
    std::vector<ChainBranch> branches;
    double                   sum = 0.;
    for (const std::string &entry : Text::split(text, ';'))
      {
        const std::size_t colon = entry.find(':');
        const auto        fraction =
          Text::to_number(Text::squeeze(entry.substr(0, colon)));
        if (colon == std::string::npos || !fraction || !(*fraction > 0.))
          throw SceneError("\"" + Text::shorten(entry) +
                           "\" must be \"fraction: relaxation time\" with a "
                           "number greater than 0 before the colon; entries "
                           "are separated by semicolons");
        branches.push_back({*fraction, entry.substr(colon + 1)});
        sum += *fraction;
      }
    if (branches.empty())
      throw SceneError(
        "must be given, for the viscosity is \"chain\": a list "
        "such as 0.5: 10; 0.3: 100");
    constexpr double rounding = 1e-12;
    if (sum > 1. + rounding)
      throw SceneError("the fractions add up to " + Text::from_number(sum) +
                       "; they must not exceed 1, the whole stiffness");
    return branches;
  }
} // namespace Crevasse
