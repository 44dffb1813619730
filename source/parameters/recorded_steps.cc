// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/parameters/recorded_steps.h>

namespace Crevasse
{
  RecordedSteps
  parse_recorded_steps(const std::string &text)
  {
    RecordedSteps steps;
    for (const std::string &entry : Text::split(text, ';'))
      {
        const std::vector<std::string> parts = Text::split(entry, ':');
        const auto period = Text::to_unsigned(parts.empty() ? "" : parts[0]);
        const auto step =
          Text::to_unsigned(parts.size() == 2 ? parts[1] : std::string());
        if (!period || *period == 0 || !step)
          throw SceneError(
            "\"" + Text::shorten(entry) +
            "\" must be \"period: step\", the period counted from 1 and the "
            "step in it from 0; entries are separated by semicolons");
        steps.emplace(*period, *step);
      }
    return steps;
  }
} // namespace Crevasse
