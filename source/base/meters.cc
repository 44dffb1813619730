// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/meters.h>
#include <crevasse/base/text.h>

#include <algorithm>

namespace Crevasse
{
  double
  report_meters(Log &log, Summary &summary)
  {
    Stopwatch::update();
    const double                               total = meters[all_else].seconds;
    std::vector<std::pair<std::string, Meter>> rows(meters.begin(),
                                                    meters.end());
    std::sort(rows.begin(), rows.end(), [](const auto &a, const auto &b) {
      return a.second.own > b.second.own;
    });

    std::string table =
      "\n  phase (exclusive)      seconds    share    calls   ms a call";
    for (const auto &[name, m] : rows)
      {
        const double share     = m.own / total;
        summary["share"][name] = share;
        table += Text::format("\n  %-20s %9.3f  %5.1f %%",
                              name.c_str(),
                              m.own,
                              100. * share);
        if (m.calls == 0.)
          continue;
        summary["seconds"][name] = m.seconds;
        summary["calls"][name]   = std::size_t(m.calls);
        const double mean        = m.own / m.calls;
        table += Text::format(" %8.0f  %10.4g", m.calls, 1e3 * mean);
        if (name == "contact problems")
          summary["seconds"]["vi_mean"] = m.seconds / m.calls;
        if (name == "linear solves")
          summary["seconds"]["back_solve_mean"] = mean;
      }
    summary["seconds"]["total"] = total;
    if (log.is_verbose)
      log.line(table);
    return total;
  }
} // namespace Crevasse
