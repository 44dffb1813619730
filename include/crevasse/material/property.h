// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_material_property_h
#define crevasse_material_property_h

#include <crevasse/base/expression.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/range.h>

#include <functional>

namespace Crevasse
{
  template <int dim>
  std::string
  describe(const Place<dim> &place)
  {
    return "at " + Text::from_point(place.point) +
           ", t = " + Text::from_number(place.t) +
           " (theta = " + Text::from_number(place.temperature) +
           ", material = " + std::to_string(place.material) + ")";
  }

  /**
   * Property of the material as a function of position, time and temperature:
   * formulas, and data computed from their values. The formulas determine its
   * arguments; points with equal values share data.
   */
  template <typename Value>
  struct Property
  {
    /** Condition on the values of the formulas. */
    struct Requirement
    {
      std::string name;  ///< "[Material] Young modulus = 1e5*x"
      std::string shown; ///< what actual() returns: "is", "has the ... "
      std::function<double(const std::vector<double> &)> actual;
      Range                                              range;
    };

    std::vector<Expression>                           formulas;
    std::function<Value(const std::vector<double> &)> make;
    std::vector<Requirement>                          requirements;

    template <int dim>
    void
    evaluate(const Place<dim> &place, std::vector<double> &values) const
    {
      values.resize(formulas.size());
      for (unsigned int i = 0; i < values.size(); ++i)
        values[i] = formulas[i].value(place);
    }

    /** @param values of the formulas at @p place.
     * @throw SceneError if they violate a requirement. */
    template <int dim>
    Value
    from_values(const std::vector<double> &values,
                const Place<dim>          &place) const
    {
      for (const Requirement &requirement : requirements)
        {
          const double actual = requirement.actual(values);
          if (!requirement.range.contains(actual))
            throw SceneError(requirement.name + ": " + requirement.shown + ' ' +
                             Text::from_number(actual) + ' ' + describe(place) +
                             "; " + requirement.range.text() + '.');
        }
      return make(values);
    }

    /** @throw SceneError if the values violate a requirement. */
    template <int dim>
    Value
    at(const Place<dim> &place) const
    {
      std::vector<double> values;
      evaluate(place, values);
      return from_values(values, place);
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
