// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/temperature/temperature.h>
#include <crevasse/temperature/temperature_series.h>

namespace Crevasse
{
  template <int dim>
  Temperature<dim>::Temperature(const std::optional<Expression> &formula,
                                const std::string               &file_name,
                                const double                     period,
                                const double                     reference)
    : reference(reference)
    , formula(formula)
  {
    if (!formula)
      file = std::make_shared<const TemperatureSeries<dim>>(file_name, period);
  }



  template <int dim>
  double
  Temperature<dim>::value(const dealii::Point<dim> &point, const double t) const
  {
    return formula ? formula->value(point, t) : file->value(point, t);
  }



  template <int dim>
  bool
  Temperature<dim>::depends_on_time() const
  {
    return formula ? formula->depends_on_time() : file->n_instants() > 1;
  }



  template <int dim>
  bool
  Temperature<dim>::is_file(const std::string &source)
  {
    return Text::suffix(source) == ".h5";
  }



  template class Temperature<2>;
  template class Temperature<3>;
} // namespace Crevasse
