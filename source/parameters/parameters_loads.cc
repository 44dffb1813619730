// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/parameters/checker.h>
#include <crevasse/parameters/parameters.h>

namespace Crevasse
{
  void
  LoadParameters::check(Problems &problems) const
  {
    const Checker checker(section, problems);
    checker.demand_positive("Period", period);

    checker.demand_valid("Traction", traction);
    checker.demand_valid("Body force", body_force);

    const std::string suffix = Text::suffix(temperature.text());
    if (suffix == ".pvd" || suffix == ".vtu" || suffix == ".pvtu")
      problems.add(section,
                   "Temperature",
                   temperature.text(),
                   "fields of other programs are converted before they are "
                   "read: \"crevasse temperature " +
                     temperature.text() + " --output temperature.h5\"");
    else
      checker.demand_valid("Temperature", temperature);
    if (temperature.is_valid() && !*temperature)
      checker.demand_file("Temperature", temperature.text());
  }
} // namespace Crevasse
