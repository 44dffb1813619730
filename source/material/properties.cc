// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/range.h>
#include <crevasse/material/isotropic.h>
#include <crevasse/material/properties.h>
#include <crevasse/material/voigt_matrix.h>

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  namespace
  {
    using Values = std::vector<double>;

    template <int dim>
    bool
    is_plane_stress(const MaterialParameters &parameters)
    {
      return dim == 2 && parameters.plane_state == PlaneState::plane_stress;
    }



    /** "[Material] Poisson ratio = 0.3". */
    std::string
    describe(const Expression &formula)
    {
      return formula.parameter() + " = " + formula.formula();
    }



    /** By how much a value lies outside of its range. */
    double
    excess(const double value, const Range &range)
    {
      return std::max(range.least - value, value - range.most);
    }



    /** A formula whose value, number @p i of all, must lie in a range. */
    template <typename Value>
    void
    add_formula(Property<Value>  &property,
                const Expression &formula,
                const Range      &range)
    {
      const std::size_t i = property.formulas.size();
      property.formulas.push_back(formula);
      property.requirements.push_back(
        {describe(formula),
         "is",
         range.text(),
         [=](const Values &values) { return excess(values[i], range); },
         [i](const Values &values) { return values[i]; }});
    }



    /** Where the rows of a matrix of the scene are among the components. */
    template <int dim>
    std::vector<unsigned int>
    places_of_rows(const std::size_t n_rows, const bool plane_stress)
    {
      if (dim == 2 && n_rows == 3 && plane_stress)
        return {0, 1, 3};
      std::vector<unsigned int> all(n_stress_components<dim>);
      for (unsigned int i = 0; i < all.size(); ++i)
        all[i] = i;
      return n_rows == all.size() ? all : std::vector<unsigned int>();
    }



    /** @p values may be longer than the matrix. */
    template <int dim>
    VoigtMatrix<dim>
    matrix_of(const Values &values, const std::vector<unsigned int> &places)
    {
      VoigtMatrix<dim>  matrix;
      const std::size_t n = places.size();
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
          matrix[places[i]][places[j]] = values[i * n + j];
      return matrix;
    }



    template <int dim>
    void
    require_symmetric_positive_definite(Property<VoigtMatrix<dim>> &property,
                                        const std::string          &what,
                                        const std::vector<unsigned int> &places)
    {
      const auto largest = [n = places.size()](const Values &values) {
        double magnitude = 0.;
        for (std::size_t i = 0; i < n * n; ++i)
          magnitude = std::max(magnitude, std::abs(values[i]));
        return magnitude;
      };
      property.requirements.push_back({what,
                                       "has the largest entry",
                                       Ranges::size.text(),
                                       [largest](const Values &values) {
                                         return excess(largest(values),
                                                       Ranges::size);
                                       },
                                       largest});
      const auto asymmetry = [places](const Values &values) {
        const auto   matrix = matrix_of<dim>(values, places);
        const double size   = matrix.norm();
        return size > 0. ? (matrix - transpose(matrix)).norm() / size : 0.;
      };
      constexpr double rounding = 1e-10;
      property.requirements.push_back({what,
                                       "has the relative asymmetry",
                                       "must be symmetric",
                                       [asymmetry](const Values &values) {
                                         return asymmetry(values) - rounding;
                                       },
                                       asymmetry});
      const auto least = [places](const Values &values) {
        const auto matrix = matrix_of<dim>(values, places);
        return least_relative_eigenvalue<dim>(0.5 *
                                                (matrix + transpose(matrix)),
                                              places.size() <
                                                n_stress_components<dim>);
      };
      constexpr double definite = 1e-14;
      property.requirements.push_back(
        {what,
         "has the relative eigenvalue",
         "must be positive definite",
         [least](const Values &values) { return definite - least(values); },
         least});
    }



    /** The formulas of K, and the function of their values that gives its
     * inverse as H of unit viscosity has it: with the 33 row of the whole
     * body, which creeps in thickness too. */
    template <int dim>
    std::function<VoigtMatrix<dim>(const Values &)>
    add_compliance(const MaterialParameters   &parameters,
                   Property<VoigtMatrix<dim>> &property)
    {
      Property<VoigtMatrix<dim>> K = stiffness_property<dim>(parameters);
      property.formulas            = std::move(K.formulas);
      if (parameters.stiffness_matrix.text().empty())
        return [](const Values &values) {
          return isotropic_compliance<dim>(values[0], values[1]);
        };
      const auto places =
        places_of_rows<dim>(parameters.stiffness_matrix->size(),
                            is_plane_stress<dim>(parameters));
      return [places](const Values &values) {
        return inverse<dim>(matrix_of<dim>(values, places));
      };
    }
  } // namespace



  template <int dim>
  Property<VoigtMatrix<dim>>
  stiffness_property(const MaterialParameters &parameters)
  {
    Property<VoigtMatrix<dim>> property;
    const bool                 plane_stress = is_plane_stress<dim>(parameters);
    if (parameters.stiffness_matrix.text().empty())
      {
        add_formula(property, *parameters.young_modulus, Ranges::positive);
        add_formula(property, *parameters.poisson_ratio, Ranges::elastic_ratio);
        property.from_values = [plane_stress](const Values &values) {
          return isotropic_stiffness<dim>(values[0], values[1], plane_stress);
        };
        return property;
      }

    const FormulaMatrix &K = parameters.stiffness_matrix;
    require_size(K, dim, plane_stress);
    property.formulas           = entries(K);
    const std::size_t n         = K->size();
    const auto        places    = places_of_rows<dim>(n, plane_stress);
    const bool        condensed = plane_stress && n == n_stress_components<dim>;
    property.from_values        = [places, condensed](const Values &values) {
      const VoigtMatrix<dim> matrix = matrix_of<dim>(values, places);
      return condensed ? condense_thickness<dim>(matrix) : matrix;
    };
    require_symmetric_positive_definite<dim>(
      property, "[Material] Stiffness matrix = " + K.text(), places);
    return property;
  }



  template <int dim>
  Property<VoigtMatrix<dim>>
  proportional_fluidity(const MaterialParameters &parameters,
                        const Expression         &relaxation_time,
                        const double              fraction)
  {
    Property<VoigtMatrix<dim>> property;
    const auto compliance = add_compliance<dim>(parameters, property);
    add_formula(property, relaxation_time, Ranges::positive);
    property.from_values = [=](const Values &values) {
      return compliance(values) / (fraction * values.back());
    };
    return property;
  }



  template <int dim>
  Property<VoigtMatrix<dim>>
  isotropic_fluidity(const MaterialParameters &parameters)
  {
    Property<VoigtMatrix<dim>> property;
    add_formula(property, *parameters.viscous_modulus, Ranges::positive);
    add_formula(property,
                *parameters.viscous_poisson_ratio,
                Ranges::viscous_ratio);
    property.from_values = [](const Values &values) {
      return isotropic_compliance<dim>(values[0], values[1]);
    };
    return property;
  }



  template <int dim>
  Property<VoigtMatrix<dim>>
  fluidity_of_matrix(const MaterialParameters &parameters)
  {
    Property<VoigtMatrix<dim>> property;
    const bool                 plane_stress = is_plane_stress<dim>(parameters);
    const FormulaMatrix       &eta          = parameters.viscosity_matrix;
    require_size(eta, dim, plane_stress);
    property.formulas    = entries(eta);
    const auto places    = places_of_rows<dim>(eta->size(), plane_stress);
    property.from_values = [places](const Values &values) {
      return inverse<dim>(matrix_of<dim>(values, places));
    };
    require_symmetric_positive_definite<dim>(
      property, "[Material] Viscosity matrix = " + eta.text(), places);
    return property;
  }



  template <int dim>
  Property<VoigtVector<dim>>
  strain_property(const Formulas &components)
  {
    Property<VoigtVector<dim>> property;
    require_size(components, dim);
    property.formulas   = *components;
    const std::size_t n = property.formulas.size();
    if (n == 1)
      property.from_values = [](const Values &values) {
        VoigtVector<dim> strain;
        for (unsigned int i = 0; i < 3; ++i)
          strain[i] = values[0];
        return strain;
      };
    else
      property.from_values = [n](const Values &values) {
        VoigtVector<dim> strain;
        strain[0] = values[0];
        strain[1] = values[1];
        strain[2] = n == 3 ? values[0] : values[2];
        for (unsigned int i = 3; i < n_stress_components<dim>; ++i)
          strain[i] = 2. * values[n == 3 ? 2 : i];
        return strain;
      };
    return property;
  }



#define INSTANTIATE(dim)                                           \
  template Property<VoigtMatrix<dim>> stiffness_property<dim>(     \
    const MaterialParameters &);                                   \
  template Property<VoigtMatrix<dim>> proportional_fluidity<dim>(  \
    const MaterialParameters &, const Expression &, const double); \
  template Property<VoigtMatrix<dim>> isotropic_fluidity<dim>(     \
    const MaterialParameters &);                                   \
  template Property<VoigtMatrix<dim>> fluidity_of_matrix<dim>(     \
    const MaterialParameters &);                                   \
  template Property<VoigtVector<dim>> strain_property<dim>(const Formulas &)

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
