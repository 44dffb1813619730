// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_material_property_h
#define crevasse_material_property_h

#include <crevasse/base/expression.h>
#include <crevasse/base/range.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace Crevasse
{
  /**
   * A property of the material as a function of place, time and temperature:
   * formulas, and what their values make. Splitting the two tells on what it
   * depends, and lets equal values share what they make.
   */
  template <typename Value>
  struct Property
  {
    /** What must hold for the values of the formulas. */
    struct Requirement
    {
      std::string name;  ///< "[Material] Young modulus = 1e5*x"
      std::string shown; ///< what actual() returns: "is", "has the ... "
      std::function<double(const std::vector<double> &)> actual;
      Range                                              range;

      /** By how much it is missed; at most 0 if it is met. */
      double
      excess(const std::vector<double> &values) const
      {
        const double value = actual(values);
        return std::max(range.least - value, value - range.most);
      }
    };

    std::vector<Expression>                           formulas;
    std::function<Value(const std::vector<double> &)> from_values;
    std::vector<Requirement>                          requirements;

    template <int dim>
    void
    evaluate(const Place<dim> &place, std::vector<double> &values) const
    {
      values.resize(formulas.size());
      for (unsigned int i = 0; i < values.size(); ++i)
        values[i] = formulas[i].value(place);
    }

    template <int dim>
    Value
    at(const Place<dim> &place) const
    {
      std::vector<double> values;
      evaluate(place, values);
      return from_values(values);
    }

    bool
    depends_on(const std::string &variable) const
    {
      for (const Expression &formula : formulas)
        if (formula.depends_on(variable))
          return true;
      return false;
    }
  };
} // namespace Crevasse

#endif
