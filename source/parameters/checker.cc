// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/range.h>
#include <crevasse/base/text.h>
#include <crevasse/base/text_file.h>
#include <crevasse/parameters/checker.h>

#include <cmath>
#include <filesystem>

namespace Crevasse
{
  Checker::Checker(const char *section, Problems &problems)
    : section(section)
    , problems(problems)
  {
  }



  void
  Checker::demand(const bool         fulfilled,
                  const char        *name,
                  const std::string &value,
                  const std::string &allowed) const
  {
    if (!fulfilled)
      problems.add(section, name, value, allowed);
  }



  void
  Checker::demand(const bool         fulfilled,
                  const char        *name,
                  const double       value,
                  const std::string &allowed) const
  {
    // Comparisons are false for NaN, but let infinity pass.
    demand(fulfilled && std::isfinite(value),
           name,
           Text::from_number(value),
           allowed);
  }



  void
  Checker::demand_positive(const char *name, const double value) const
  {
    demand(value > 0., name, value, "must be greater than 0");
    demand(!(value > 0.) || Ranges::size.contains(value),
           name,
           value,
           std::string(Ranges::size.text) + "; choose other units");
  }



  void
  Checker::demand_readable(const char                  *name,
                           const std::string           &value,
                           const std::function<void()> &read) const
  {
    try
      {
        read();
      }
    catch (const SceneError &error)
      {
        problems.add(section, name, value, error.what());
      }
  }



  void
  Checker::demand_file(const char *name, const std::string &file_name) const
  {
    const std::string obstacle = why_unreadable(file_name);
    if (!obstacle.empty())
      {
        problems.add_unreadable(section, name, file_name, obstacle);
        return;
      }
    // Pipes and the like have no size.
    std::error_code no_size;
    demand(std::filesystem::file_size(file_name, no_size) != 0 || no_size,
           name,
           file_name,
           "is empty");
  }
} // namespace Crevasse
