// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/expression.h>
#include <crevasse/base/text.h>
#include <crevasse/parameters/checker.h>
#include <crevasse/parameters/parameters.h>
#include <crevasse/temperature/temperature.h>

namespace Crevasse
{
  void
  LoadParameters::check(Problems &problems) const
  {
    const Checker checker(section, problems);
    checker.demand_positive("Period", period);

    const auto check_formulas = [&](const char        *name,
                                    const std::string &formulas) {
      for (const std::string &formula : Text::split(formulas, ';'))
        checker.demand_readable(name, formulas, [&]() {
          Expression expression(formula);
        });
    };
    check_formulas("Traction", traction);
    check_formulas("Body force", body_force);

    const std::string suffix = Text::suffix(temperature);
    if (suffix == ".pvd" || suffix == ".vtu" || suffix == ".pvtu")
      problems.add(section,
                   "Temperature",
                   temperature,
                   "fields of other programs are converted before they are "
                   "read: \"crevasse temperature " +
                     temperature + " --output temperature.h5\"");
    else if (Temperature<2>::is_file(temperature))
      checker.demand_file("Temperature", temperature);
    else
      checker.demand_readable("Temperature", temperature, [&]() {
        try
          {
            Expression expression(temperature);
          }
        catch (const SceneError &error)
          {
            throw SceneError(std::string(error.what()) +
                             " (names of files end in .csv or .h5)");
          }
      });
  }
} // namespace Crevasse
