// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/lip/lip_status.h>

#include <algorithm>

namespace Crevasse
{
  std::array<double, 2>
  closed_parts(const std::vector<LipMoment> &lip)
  {
    // Each half of an interval has the status of the nearer end.
    std::array<double, 3> part   = {};
    const double          period = lip.back().instant - lip.front().instant;
    for (std::size_t i = 1; i < lip.size(); ++i)
      for (const LipStatus status : {lip[i - 1].status, lip[i].status})
        part[static_cast<unsigned int>(status)] +=
          0.5 * (lip[i].instant - lip[i - 1].instant) / period;
    return {{part[2], part[1]}};
  }



  LipOpening
  last_opening(const std::vector<LipMoment> &lip, const double instant)
  {
    auto begin =
      std::find_if(lip.rbegin(), lip.rend(), [=](const auto &moment) {
        return moment.instant <= instant;
      });
    if (begin->status != LipStatus::open)
      return {0., "the lip is not wholly open at the largest stress intensity"};
    // The motion is periodic: the last period ended like this one.
    const auto is_pressed = [](const LipMoment &moment) {
      return moment.status != LipStatus::open;
    };
    auto last = std::find_if(begin, lip.rend(), is_pressed);
    if (last == lip.rend())
      last = std::find_if(lip.rbegin(), begin, is_pressed);
    if (last == begin)
      return {0., "the lip is open throughout the period"};
    return {last->instant, ""};
  }
} // namespace Crevasse
