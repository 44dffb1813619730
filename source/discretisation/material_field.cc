// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/discretisation/cell_values.h>
#include <crevasse/discretisation/material_field.h>
#include <crevasse/parameters/formulas.h>

#include <algorithm>
#include <map>
#include <string>
#include <unordered_map>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** A material with more values than these is taken as one that varies from
     * point to point: looking for equal ones would be in vain. */
    constexpr std::size_t worth_sharing = 1000;



    /** The bytes of some values, as the key of what they make. */
    std::string
    key_of(const std::vector<double> &values)
    {
      return {reinterpret_cast<const char *>(values.data()),
              values.size() * sizeof(double)};
    }



    /** Those that are not 0. */
    template <int dim>
    std::vector<const typename MaxwellLaw<dim>::FreeStrain *>
    free_strains_of(const MaxwellLaw<dim>  &law,
                    const Temperature<dim> &temperature)
    {
      std::vector<const typename MaxwellLaw<dim>::FreeStrain *> strains;
      for (const auto &strain : law.free_strains())
        if (!are_zero(strain.value.formulas) &&
            !(strain.is_thermal && temperature.is_zero()))
          strains.push_back(&strain);
      return strains;
    }



    void
    require_positive(const double      value,
                     const Expression &factor,
                     const char       *name,
                     const double      t)
    {
      if (!(value > 0.))
        throw NumericalError(
          Text::parameter(MaterialParameters::section, name) + " = " +
          factor.formula() + ": is " + Text::from_number(value) +
          " at t = " + Text::from_number(t) + "; it must be greater than 0.");
    }
  } // namespace



  template <int dim>
  MaterialField<dim>::MaterialField(const Space<dim>           &space,
                                    const QuadratureField<dim> &points,
                                    const MaxwellLaw<dim>      &law,
                                    const Temperature<dim>     &temperature)
    : communicator(space.communicator())
    , law(law)
    , temperature(temperature)
    , free_strains(free_strains_of(law, temperature))
    , stiffness_is_free(varies_in_time(law.stiffness()))
    , thermal_strain_is_free(
        std::any_of(free_strains.begin(),
                    free_strains.end(),
                    [&](const FreeStrain *strain) {
                      return varies_in_time(strain->value) ||
                             (strain->is_thermal &&
                              temperature.depends_on_time());
                    }))
    , n_points(points.n_local_points())
  {
    for (const auto &branch : law.branches())
      fluidity_is_free.push_back(varies_in_time(branch.fluidity));
    bool of_importance =
      varies_in_space(law.stiffness()) || thermal_strain_varies_in_space();
    for (const auto &branch : law.branches())
      of_importance = of_importance || varies_in_space(branch.fluidity);
    if (of_importance)
      {
        CellValues<dim> cell_values(space, update_quadrature_points);
        locations.resize(n_points);
        materials.resize(n_points);
        for (const auto &cell : space.dof_handler().active_cell_iterators())
          if (cell->is_locally_owned())
            {
              const FEValues<dim> &values = cell_values.reinit(cell);
              const std::size_t    first  = points.first_point(cell);
              for (const unsigned int q : values.quadrature_point_indices())
                {
                  locations[first + q] = values.quadrature_point(q);
                  materials[first + q] = cell->material_id();
                }
            }
      }

    check_requirements({0.});
    constant.plane_stress = law.is_plane_stress();
    for (const auto &branch : law.branches())
      {
        constant.fractions.push_back(branch.fraction);
        constant.spring -= branch.fraction;
      }
    if (!law.has_spring())
      constant.spring = 0.; // but for rounding
    constant.fluidity.resize(law.branches().size());
    collectively(communicator, [&]() {
      if (!stiffness_varies())
        constant.stiffness = evaluate(law.stiffness(), 0.);
      for (unsigned int i = 0; i < constant.fluidity.size(); ++i)
        if (!fluidity_is_free[i])
          constant.fluidity[i] = evaluate(law.branches()[i].fluidity, 0.);
      if (has_thermal_strain() && !thermal_strain_varies())
        constant.thermal_strain = evaluate_thermal_strain(0.);
    });
  }



  template <int dim>
  template <typename Value>
  bool
  MaterialField<dim>::varies_in_space(const Property<Value> &property) const
  {
    for (const char *variable : {"x", "y", "z", "material"})
      if (property.depends_on(variable))
        return true;
    return property.depends_on("theta") && temperature.depends_on_space();
  }



  template <int dim>
  template <typename Value>
  bool
  MaterialField<dim>::varies_in_time(const Property<Value> &property) const
  {
    return property.depends_on("t") ||
           (property.depends_on("theta") && temperature.depends_on_time());
  }



  template <int dim>
  bool
  MaterialField<dim>::thermal_strain_varies_in_space() const
  {
    return std::any_of(free_strains.begin(),
                       free_strains.end(),
                       [this](const FreeStrain *strain) {
                         return varies_in_space(strain->value) ||
                                (strain->is_thermal &&
                                 temperature.depends_on_space());
                       });
  }



  template <int dim>
  Place<dim>
  MaterialField<dim>::place(const std::size_t point,
                            const double      t,
                            const bool        with_temperature) const
  {
    Place<dim> place;
    place.t = t;
    if (!locations.empty())
      {
        place.point    = locations[point];
        place.material = materials[point];
      }
    if (with_temperature)
      place.temperature = temperature.value(place.point, t);
    return place;
  }



  template <int dim>
  template <typename Value>
  std::shared_ptr<const PointValues<Value>>
  MaterialField<dim>::evaluate(const Property<Value> &property,
                               const double           t) const
  {
    const bool with_temperature = property.depends_on("theta");
    if (!varies_in_space(property))
      return std::make_shared<const PointValues<Value>>(
        property.at(place(0, t, with_temperature)));

    std::vector<Value>                             distinct;
    std::vector<std::uint32_t>                     which(n_points);
    std::unordered_map<std::string, std::uint32_t> numbers;
    std::vector<double>                            values;
    for (std::size_t p = 0; p < n_points; ++p)
      {
        if (distinct.size() > worth_sharing)
          return evaluate_at_each_point(property, t);
        property.evaluate(place(p, t, with_temperature), values);
        const auto [number, is_new] =
          numbers.emplace(key_of(values), distinct.size());
        if (is_new)
          distinct.push_back(property.from_values(values));
        which[p] = number->second;
      }
    return std::make_shared<const PointValues<Value>>(std::move(distinct),
                                                      std::move(which));
  }



  template <int dim>
  template <typename Value>
  std::shared_ptr<const PointValues<Value>>
  MaterialField<dim>::evaluate_at_each_point(const Property<Value> &property,
                                             const double           t) const
  {
    const bool         with_temperature = property.depends_on("theta");
    std::vector<Value> values(n_points);
    for (std::size_t p = 0; p < n_points; ++p)
      values[p] = property.at(place(p, t, with_temperature));
    return std::make_shared<const PointValues<Value>>(std::move(values));
  }



  template <int dim>
  std::shared_ptr<const typename MaterialField<dim>::Vectors>
  MaterialField<dim>::evaluate_thermal_strain(const double t) const
  {
    const auto strain_at = [&](const std::size_t point) {
      const Place<dim> here = place(point, t, true);
      VoigtVector<dim> sum;
      for (const FreeStrain *strain : free_strains)
        sum += strain->is_thermal ? strain->value.at(here) * here.temperature
                                  : strain->value.at(here);
      return sum;
    };
    if (!thermal_strain_varies_in_space())
      return std::make_shared<const Vectors>(strain_at(0));
    std::vector<VoigtVector<dim>> strains(n_points);
    for (std::size_t p = 0; p < n_points; ++p)
      strains[p] = strain_at(p);
    return std::make_shared<const Vectors>(std::move(strains));
  }



  template <int dim>
  bool
  MaterialField<dim>::fluidity_varies() const
  {
    return std::find(fluidity_is_free.begin(), fluidity_is_free.end(), true) !=
           fluidity_is_free.end();
  }



  template <int dim>
  std::size_t
  MaterialField<dim>::memory_of_variation(const MaterialState<dim> &state) const
  {
    std::size_t bytes = 0;
    if (stiffness_is_free)
      bytes += state.stiffness->memory_consumption();
    for (unsigned int i = 0; i < fluidity_is_free.size(); ++i)
      if (fluidity_is_free[i])
        bytes += state.fluidity[i]->memory_consumption();
    if (thermal_strain_is_free)
      bytes += state.thermal_strain->memory_consumption();
    return bytes;
  }



  template <int dim>
  MaterialState<dim>
  MaterialField<dim>::at(const double t) const
  {
    MaterialState<dim> state = constant;
    if (stiffness_varies() || fluidity_varies() || thermal_strain_varies())
      collectively(communicator, [&]() {
        if (state.stiffness == nullptr)
          state.stiffness = evaluate(law.stiffness(), t);
        for (unsigned int i = 0; i < state.fluidity.size(); ++i)
          if (state.fluidity[i] == nullptr)
            state.fluidity[i] = evaluate(law.branches()[i].fluidity, t);
        if (thermal_strain_varies())
          state.thermal_strain = evaluate_thermal_strain(t);
      });
    set_factors(t, state);
    return state;
  }



  template <int dim>
  void
  MaterialField<dim>::set_factors(const double        t,
                                  MaterialState<dim> &state) const
  {
    state.stiffness_factor = law.stiffness_factor().value(Point<dim>(), t);
    state.viscosity_factor = law.viscosity_factor().value(Point<dim>(), t);
    require_positive(state.stiffness_factor,
                     law.stiffness_factor(),
                     "Stiffness time factor",
                     t);
    require_positive(state.viscosity_factor,
                     law.viscosity_factor(),
                     "Viscosity time factor",
                     t);
  }



  template class MaterialField<2>;
  template class MaterialField<3>;
} // namespace Crevasse
