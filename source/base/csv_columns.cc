// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/csv_columns.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/base/text_file.h>

#include <algorithm>
#include <limits>

namespace Crevasse
{
  std::map<std::string, std::vector<double>>
  read_csv_columns(const std::string              &file_name,
                   const std::vector<std::string> &required)
  {
    std::map<std::string, std::vector<double>> columns;
    std::vector<std::string>                   names;
    std::istringstream                         text(read_text_file(file_name));
    unsigned int                               row = 0;
    const auto demand = [&](const bool fulfilled, const std::string &why) {
      if (!fulfilled)
        throw SceneError(file_name + ", line " + std::to_string(row) + ": " +
                         why);
    };
    for (std::string line; std::getline(text, line);)
      {
        ++row;
        // A comma at the end would leave out the last, empty cell.
        std::vector<std::string> cells =
          Text::split(Text::squeeze(line) + ",", ',');
        if (cells[0].empty() && cells.size() == 1)
          continue;
        if (cells[0][0] == '#')
          continue;
        if (names.empty())
          {
            names = cells;
            for (const std::string &name : required)
              demand(std::count(names.begin(), names.end(), name) == 1,
                     "there must be one column \"" + name +
                       "\"; the columns are " + Text::join(names, ", "));
            continue;
          }
        demand(cells.size() == names.size(),
               "there are " + std::to_string(cells.size()) +
                 " cells for the columns " + Text::join(names, ", "));
        for (std::size_t i = 0; i < cells.size(); ++i)
          {
            const auto number = Text::to_number(cells[i]);
            const bool is_void =
              cells[i].empty() &&
              std::count(required.begin(), required.end(), names[i]) == 0;
            demand(number || is_void,
                   names[i] + " = \"" + Text::shorten(cells[i]) +
                     "\" must be a number");
            columns[names[i]].push_back(
              number.value_or(std::numeric_limits<double>::quiet_NaN()));
          }
      }
    demand(!columns.empty(), "there are no rows of numbers");
    return columns;
  }
} // namespace Crevasse
