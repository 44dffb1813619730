// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/material/maxwell_law.h>
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



    /** Formats a coefficient: "[Material] Poisson ratio = 0.3". */
    std::string
    describe(const Expression &formula)
    {
      return formula.parameter() + " = " + formula.formula();
    }



    /** Adds a formula whose value must lie in a range. */
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
         [i](const Values &values) { return values[i]; },
         range});
    }



    /** Component of each row of a matrix in a scene; empty: wrong size. */
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



    /** Matrix from its entries by rows; further @p values are ignored. */
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
      constexpr double infinity = std::numeric_limits<double>::infinity();
      const auto       require =
        [&](const char *shown, const auto &actual, const Range &range) {
          property.requirements.push_back({what, shown, actual, range});
        };
      require(
        "has the largest entry",
        [n = places.size()](const Values &values) {
          double magnitude = 0.;
          for (std::size_t i = 0; i < n * n; ++i)
            magnitude = std::max(magnitude, std::abs(values[i]));
          return magnitude;
        },
        Ranges::size);
      require("has the relative asymmetry",
              [places](const Values &values) {
                const auto   matrix = matrix_of<dim>(values, places);
                const double size   = matrix.norm();
                return size > 0. ? (matrix - transpose(matrix)).norm() / size
                                 : 0.;
              },
              {-infinity, 1e-10, "symmetric"});
      require("has the relative eigenvalue",
              [places](const Values &values) {
                const auto matrix = matrix_of<dim>(values, places);
                return least_relative_eigenvalue<dim>(
                  0.5 * (matrix + transpose(matrix)),
                  places.size() < n_stress_components<dim>);
              },
              {1e-14, infinity, "positive definite"});
    }



    /** Stiffness K, isotropic or from Stiffness matrix. */
    template <int dim>
    Property<VoigtMatrix<dim>>
    stiffness_property(const MaterialParameters &parameters)
    {
      Property<VoigtMatrix<dim>> property;
      const bool plane_stress = is_plane_stress<dim>(parameters);
      if (parameters.stiffness_matrix.text().empty())
        {
          add_formula(property, *parameters.young_modulus, Ranges::positive);
          add_formula(property,
                      *parameters.poisson_ratio,
                      Ranges::elastic_ratio);
          property.make = [plane_stress](const Values &values) {
            return isotropic_stiffness<dim>(values[0], values[1], plane_stress);
          };
          return property;
        }

      const FormulaMatrix &K = parameters.stiffness_matrix;
      require_size(K, dim, plane_stress);
      property.formulas        = entries(K);
      const std::size_t n      = K->size();
      const auto        places = places_of_rows<dim>(n, plane_stress);
      const bool condensed     = plane_stress && n == n_stress_components<dim>;
      property.make            = [places, condensed](const Values &values) {
        const VoigtMatrix<dim> matrix = matrix_of<dim>(values, places);
        return condensed ? condense_thickness<dim>(matrix) : matrix;
      };
      require_symmetric_positive_definite<dim>(
        property, "[Material] Stiffness matrix = " + K.text(), places);
      return property;
    }



    /** Adds the formulas of K, and returns K⁻¹ as a function of their values,
     * with row 33 also in plane stress, because the thickness creeps; of its
     * shear alone if the bulk modulus stays elastic. */
    template <int dim>
    std::function<VoigtMatrix<dim>(const Values &)>
    add_compliance(const MaterialParameters   &parameters,
                   Property<VoigtMatrix<dim>> &property)
    {
      Property<VoigtMatrix<dim>> K = stiffness_property<dim>(parameters);
      property.formulas            = std::move(K.formulas);
      if (parameters.relaxes_in_shear_only())
        return [](const Values &values) {
          return isotropic_compliance<dim>(1.5 * values[0] / (1. + values[1]),
                                           0.5);
        };
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



    /** Fluidity H = (τK)⁻¹ / fraction. */
    template <int dim>
    Property<VoigtMatrix<dim>>
    proportional_fluidity(const MaterialParameters &parameters,
                          const Expression         &relaxation_time,
                          const double              fraction)
    {
      Property<VoigtMatrix<dim>> property;
      const auto compliance = add_compliance<dim>(parameters, property);
      add_formula(property, relaxation_time, Ranges::positive);
      property.make = [=](const Values &values) {
        return compliance(values) / (fraction * values.back());
      };
      return property;
    }



    /** Fluidity of Viscous modulus and Viscous Poisson ratio. */
    template <int dim>
    Property<VoigtMatrix<dim>>
    isotropic_fluidity(const MaterialParameters &parameters)
    {
      Property<VoigtMatrix<dim>> property;
      add_formula(property, *parameters.viscous_modulus, Ranges::positive);
      add_formula(property,
                  *parameters.viscous_poisson_ratio,
                  Ranges::viscous_ratio);
      property.make = [](const Values &values) {
        return isotropic_compliance<dim>(values[0], values[1]);
      };
      return property;
    }



    /** Fluidity H = η⁻¹ of Viscosity matrix. */
    template <int dim>
    Property<VoigtMatrix<dim>>
    fluidity_of_matrix(const MaterialParameters &parameters)
    {
      Property<VoigtMatrix<dim>> property;
      const bool           plane_stress = is_plane_stress<dim>(parameters);
      const FormulaMatrix &eta          = parameters.viscosity_matrix;
      require_size(eta, dim, plane_stress);
      property.formulas = entries(eta);
      const auto places = places_of_rows<dim>(eta->size(), plane_stress);
      property.make     = [places](const Values &values) {
        return inverse<dim>(matrix_of<dim>(values, places));
      };
      require_symmetric_positive_definite<dim>(
        property, "[Material] Viscosity matrix = " + eta.text(), places);
      return property;
    }



    /** Strain, with engineering shears, from a scalar or a tensor. */
    template <int dim>
    Property<VoigtVector<dim>>
    strain_property(const Formulas &components)
    {
      Property<VoigtVector<dim>> property;
      require_size(components, dim);
      property.formulas   = *components;
      const std::size_t n = property.formulas.size();
      if (n == 1)
        property.make = [](const Values &values) {
          VoigtVector<dim> strain;
          for (unsigned int i = 0; i < 3; ++i)
            strain[i] = values[0];
          return strain;
        };
      else
        property.make = [n](const Values &values) {
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



    Property<CreepLaw::Constants>
    make_creep_constants(const MaterialParameters &parameters)
    {
      Property<CreepLaw::Constants> property;
      if (const CreepLaw *law = parameters.creep_law())
        for (const CreepLawParameter &parameter : law->parameters)
          add_formula(property,
                      *parameters.of_creep.at(parameter.name),
                      parameter.range);
      property.make = [](const Values &values) {
        CreepLaw::Constants constants{{std::log(values[0])}};
        std::copy(values.begin() + 1, values.end(), constants.begin() + 1);
        return constants;
      };
      return property;
    }



    template <int dim>
    std::vector<typename MaxwellLaw<dim>::Branch>
    make_branches(const MaterialParameters &parameters)
    {
      using Branch = typename MaxwellLaw<dim>::Branch;
      std::vector<Branch> branches;
      switch (parameters.viscosity)
        {
          case ViscosityType::relaxation_time:
            branches.push_back(
              {1.,
               proportional_fluidity<dim>(parameters,
                                          *parameters.relaxation_time,
                                          1.)});
            break;
          case ViscosityType::isotropic:
            branches.push_back({1., isotropic_fluidity<dim>(parameters)});
            break;
          case ViscosityType::matrix:
            branches.push_back({1., fluidity_of_matrix<dim>(parameters)});
            break;
          case ViscosityType::chain:
            for (const ChainBranch &branch : parameters.branches())
              branches.push_back(
                {branch.fraction,
                 proportional_fluidity<dim>(parameters,
                                            branch.relaxation_time,
                                            branch.fraction)});
            break;
          default:
            break;
        }
      if (parameters.creep_law() != nullptr)
        branches.push_back(
          {1.,
           {{},
            [](const Values &) { return isotropic_compliance<dim>(1., 0.5); },
            {}}});
      return branches;
    }



    double
    factor_at(const double t, const Expression &factor)
    {
      const double value = factor.value(dealii::Point<2>(), t);
      if (!Ranges::positive.contains(value))
        throw SceneError(describe(factor) + ": is " + Text::from_number(value) +
                         " at t = " + Text::from_number(t) + "; " +
                         Ranges::positive.text() + '.');
      return value;
    }
  } // namespace



  template <int dim>
  MaxwellLaw<dim>::MaxwellLaw(const MaterialParameters &parameters)
    : stiffness(stiffness_property<dim>(parameters))
    , branches(make_branches<dim>(parameters))
    , creep(parameters.creep_law())
    , creep_constants(make_creep_constants(parameters))
    , mean_expansion_from(*parameters.mean_expansion_from)
    , plane_stress(dim == 2 &&
                   parameters.plane_state == PlaneState::plane_stress)
    , k(*parameters.stiffness_time_factor)
    , eta_0(*parameters.viscosity_time_factor)
  {
    for (const auto &strain : parameters.free_strains())
      free_strains.push_back(
        {strain_property<dim>(strain.components), strain.is_thermal});
    if (parameters.viscosity != ViscosityType::relaxation_time)
      return;
    const Expression &tau  = *parameters.relaxation_time;
    const bool has_factors = !k.is_constant() || k.value(Place<dim>()) != 1. ||
                             !eta_0.is_constant() ||
                             eta_0.value(Place<dim>()) != 1.;
    if (!has_factors && tau.is_constant())
      uniform_relaxation_time = tau.value(Place<dim>());
  }



  template <int dim>
  double
  MaxwellLaw<dim>::stiffness_factor(const double t) const
  {
    return factor_at(t, k);
  }



  template <int dim>
  double
  MaxwellLaw<dim>::viscosity_factor(const double t) const
  {
    return factor_at(t, eta_0);
  }



  template class MaxwellLaw<2>;
  template class MaxwellLaw<3>;
} // namespace Crevasse
