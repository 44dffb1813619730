// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/temperature/temperature.h>
#include <crevasse/temperature/temperature_series.h>
#include <crevasse/temperature/temperature_table.h>

namespace Crevasse
{
  template <int dim>
  Temperature<dim>::Temperature(const std::optional<Expression> &formula,
                                const std::string               &file_name,
                                const double                     period)
    : formula(formula)
  {
    if (!formula && Text::suffix(file_name) == ".csv")
      file = std::make_unique<TemperatureTable<dim>>(file_name, period);
    else if (!formula)
      file = std::make_unique<TemperatureSeries<dim>>(file_name, period);
  }



  template <int dim>
  bool
  Temperature<dim>::is_file(const std::string &source)
  {
    const std::string suffix = Text::suffix(source);
    return suffix == ".csv" || suffix == ".h5";
  }



  template class Temperature<2>;
  template class Temperature<3>;
} // namespace Crevasse
