// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/discretisation/cell_values.h>
#include <crevasse/discretisation/material_field.h>
#include <crevasse/parameters/formulas.h>

#include <deal.II/grid/grid_tools.h>

#include <boost/serialization/set.hpp>
#include <boost/serialization/utility.hpp>
#include <unordered_map>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Largest number of values of a material that are compared: a material
     * with more values varies from point to point. */
    constexpr std::size_t worth_sharing = 1000;



    /** Bytes of values, as a key of objects made from them. */
    std::string
    key_of(const std::vector<double> &values)
    {
      return {reinterpret_cast<const char *>(values.data()),
              values.size() * sizeof(double)};
    }



    /** Gives each material the first unused number: materials that neither meet
     * nor meet a third one may share it. @param materials By cell index. */
    template <int dim>
    void
    share_numbers(const Mesh<dim>           &mesh,
                  const unsigned int         n_materials,
                  std::vector<unsigned int> &materials)
    {
      using Cell = typename Triangulation<dim>::active_cell_iterator;
      GridTools::exchange_cell_data_to_ghosts<unsigned int, Triangulation<dim>>(
        mesh,
        [&](const Cell &cell) { return materials[cell->active_cell_index()]; },
        [&](const Cell &cell, const unsigned int material) {
          materials[cell->active_cell_index()] = material;
        });
      const auto cells_of = GridTools::vertex_to_cell_map(mesh);
      std::set<std::pair<unsigned int, unsigned int>> near; // larger first
      for (const auto &cell : owned_cells(mesh))
        {
          std::set<unsigned int> around;
          for (const unsigned int v : cell->vertex_indices())
            for (const auto &other : cells_of[cell->vertex_index(v)])
              if (!other->is_artificial())
                around.insert(materials[other->active_cell_index()]);
          for (const unsigned int a : around)
            for (const unsigned int b : around)
              if (a > b)
                near.emplace(a, b);
        }
      for (const auto &of_rank :
           Utilities::MPI::all_gather(mesh.get_communicator(), near))
        near.insert(of_rank.begin(), of_rank.end());

      std::vector<unsigned int> numbers(n_materials);
      auto                      pair = near.begin();
      for (unsigned int material = 0; material < n_materials; ++material)
        {
          std::set<unsigned int> taken;
          for (; pair != near.end() && pair->first == material; ++pair)
            taken.insert(numbers[pair->second]);
          while (taken.count(numbers[material]) > 0)
            ++numbers[material];
        }
      for (unsigned int &material : materials)
        material = numbers[material];
    }



    /** Free strains that are not 0. */
    template <int dim>
    std::vector<const typename MaxwellLaw<dim>::FreeStrain *>
    free_strains_of(const MaxwellLaw<dim>  &law,
                    const Temperature<dim> &temperature)
    {
      std::vector<const typename MaxwellLaw<dim>::FreeStrain *> strains;
      for (const auto &strain : law.free_strains)
        if (!are_zero(strain.value.formulas) &&
            !(strain.is_thermal && temperature.is_zero()))
          strains.push_back(&strain);
      return strains;
    }



    /** Names of the parameters of free strains. */
    template <typename FreeStrains>
    std::string
    names_of(const FreeStrains &strains)
    {
      std::string names;
      bool        are_thermal = false;
      for (const auto *strain : strains)
        {
          names += (names.empty() ? "" : ", ") +
                   strain->value.formulas.front().parameter();
          are_thermal = are_thermal || strain->is_thermal;
        }
      return names + (are_thermal ? " and [Loads] Temperature" : "");
    }
  } // namespace



  template <int dim>
  MaterialField<dim>::MaterialField(const Space<dim>               &space,
                                    const QuadratureField<dim>     &points,
                                    const MaxwellLaw<dim>          &law,
                                    const Temperature<dim>         &temperature,
                                    const ImposedDisplacement<dim> *imposed)
    : communicator(space.communicator())
    , law(law)
    , temperature(temperature)
    , imposed(imposed != nullptr && imposed->is_on ? imposed : nullptr)
    , free_strains(free_strains_of(law, temperature))
    , n_points(points.n_local_points)
  {
    stiffness_varies = varies_in_time(law.stiffness);
    for (const auto &branch : law.branches)
      {
        fluidity_is_free.push_back(varies_in_time(branch.fluidity));
        fluidity_varies = fluidity_varies || fluidity_is_free.back();
      }
    fluidity_varies    = fluidity_varies || varies_in_time(law.creep_constants);
    has_thermal_strain = !free_strains.empty();
    for (const FreeStrain *strain : free_strains)
      thermal_strain_varies =
        thermal_strain_varies || varies_in_time(strain->value) ||
        (strain->is_thermal && temperature.depends_on_time());
    bool of_importance =
      varies_in_space(law.stiffness) || thermal_strain_varies_in_space();
    for (const auto &branch : law.branches)
      of_importance = of_importance || varies_in_space(branch.fluidity);
    if (of_importance || varies_in_space(law.creep_constants))
      {
        locations.resize(n_points);
        materials.resize(n_points);
        for_each_point(space,
                       update_quadrature_points,
                       [&](const FEValues<dim> &values,
                           const unsigned int   q,
                           const std::size_t    point) {
                         locations[point] = values.quadrature_point(q);
                         materials[point] = values.get_cell()->material_id();
                       });
      }

    constant.plane_stress = law.plane_stress;
    constant.hardens      = law.hardens();
    for (const auto &branch : law.branches)
      {
        constant.fractions.push_back(branch.fraction);
        constant.spring -= branch.fraction;
      }
    if (!law.has_spring())
      constant.spring = 0.; // removes rounding
    constant.fluidity.resize(law.branches.size());
    collectively(communicator, [&]() {
      if (!stiffness_varies)
        constant.stiffness = evaluate(law.stiffness, 0.);
      for (unsigned int i = 0; i < constant.fluidity.size(); ++i)
        if (!fluidity_is_free[i])
          constant.fluidity[i] = evaluate(law.branches[i].fluidity, 0.);
      if (has_thermal_strain && !thermal_strain_varies)
        constant.thermal_strain = evaluate_thermal_strain(0.);
      if (law.creep != nullptr && !stiffness_varies && !fluidity_varies)
        constant.creep = evaluate_creep(*constant.stiffness, 0.);
    });
    if (!free_strain_varies())
      constant.free_strain = evaluate_free_strain(constant.thermal_strain, 0.);
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
          {
            distinct.resize(n_points);
            for (std::size_t each = 0; each < n_points; ++each)
              distinct[each] = property.at(place(each, t, with_temperature));
            return std::make_shared<const PointValues<Value>>(
              std::move(distinct));
          }
        const Place<dim> here = place(p, t, with_temperature);
        property.evaluate(here, values);
        const auto [number, is_new] =
          numbers.emplace(key_of(values), distinct.size());
        if (is_new)
          distinct.push_back(property.from_values(values, here));
        which[p] = number->second;
      }
    return std::make_shared<const PointValues<Value>>(std::move(distinct),
                                                      std::move(which));
  }



  template <int dim>
  std::shared_ptr<const typename MaterialField<dim>::Vectors>
  MaterialField<dim>::evaluate_thermal_strain(const double t) const
  {
    const auto strain_at = [&](const std::size_t point) {
      const Place<dim> here = place(point, t, true);
      VoigtVector<dim> sum;
      for (const FreeStrain *strain : free_strains)
        sum += strain->is_thermal ? thermal_strain(strain->value, here)
                                  : strain->value.at(here);
      for (unsigned int i = 0; i < n_stress_components<dim>; ++i)
        if (!Ranges::any_number.contains(sum[i]))
          throw SceneError(
            names_of(free_strains) + ": the thermal strain is " +
            Text::from_number(sum[i]) + ' ' + describe(here) + "; it " +
            Ranges::any_number.text() +
            ", and the theory of small strains is for much less than 1.");
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
  std::shared_ptr<const PointValues<CreepPoint<dim>>>
  MaterialField<dim>::evaluate_creep(const Matrices &stiffness,
                                     const double    t) const
  {
    const auto modes =
      transform(stiffness, n_points, [](const VoigtMatrix<dim> &K) {
        return RelaxationModes<dim>(isotropic_compliance<dim>(1., 0.5), K);
      });
    return std::make_shared<const PointValues<CreepPoint<dim>>>(
      combine(*evaluate(law.creep_constants, t),
              modes,
              n_points,
              [this](const auto &constants, const auto &modes) {
                return CreepPoint<dim>{law.creep, constants, modes};
              }));
  }



  template <int dim>
  std::vector<unsigned int>
  MaterialField<dim>::materials_of_cells(
    const Space<dim>           &space,
    const QuadratureField<dim> &points) const
  {
    std::vector<std::string> keys;
    for (const auto &cell : owned_cells(space.mesh()))
      keys.push_back(std::to_string(cell->material_id()));
    const auto distinguish = [&](const Matrices &values) {
      if (values.is_uniform())
        return;
      int  constant = 0; // constant minus varying cells
      auto longer   = keys;
      auto key      = longer.begin();
      for (const auto &cell : owned_cells(space.mesh()))
        {
          std::set<std::string> distinct;
          const std::size_t     first = points.first_point(cell);
          for (unsigned int q = 0; q < space.quadrature(cell).size(); ++q)
            {
              std::vector<double> entries;
              for (unsigned int i = 0; i < n_stress_components<dim>; ++i)
                for (unsigned int j = 0; j < n_stress_components<dim>; ++j)
                  entries.push_back(values[first + q][i][j]);
              distinct.insert(key_of(entries));
            }
          // Cells within which moduli vary are one material.
          const bool is_constant = distinct.size() == 1;
          constant += is_constant ? 1 : -1;
          *key++ += is_constant ? *distinct.begin() : "varying";
        }
      if (Utilities::MPI::sum(constant, communicator) > 0)
        keys = longer;
    };
    const MaterialState<dim> state = at(0.);
    distinguish(*state.stiffness);
    for (const auto &fluidity : state.fluidity)
      distinguish(*fluidity);

    std::map<std::string, unsigned int> numbers;
    for (const auto &of_rank : Utilities::MPI::all_gather(
           communicator, std::set<std::string>(keys.begin(), keys.end())))
      for (const std::string &key : of_rank)
        numbers.emplace(key, 0);
    unsigned int next = 0;
    for (auto &[key, number] : numbers)
      number = next++;
    std::vector<unsigned int> materials(space.mesh().n_active_cells());
    auto                      key = keys.begin();
    for (const auto &cell : owned_cells(space.mesh()))
      materials[cell->active_cell_index()] = numbers.at(*key++);
    if (numbers.size() > 2)
      share_numbers(space.mesh(), numbers.size(), materials);
    return materials;
  }



  template <int dim>
  MaterialState<dim>
  MaterialField<dim>::at(const double t) const
  {
    MaterialState<dim> state = constant;
    if (stiffness_varies || fluidity_varies || free_strain_varies())
      collectively(communicator, [&]() {
        if (state.stiffness == nullptr)
          state.stiffness = evaluate(law.stiffness, t);
        for (unsigned int i = 0; i < state.fluidity.size(); ++i)
          if (state.fluidity[i] == nullptr)
            state.fluidity[i] = evaluate(law.branches[i].fluidity, t);
        if (thermal_strain_varies)
          state.thermal_strain = evaluate_thermal_strain(t);
        if (law.creep != nullptr && state.creep == nullptr)
          state.creep = evaluate_creep(*state.stiffness, t);
      });
    if (free_strain_varies())
      state.free_strain = evaluate_free_strain(state.thermal_strain, t);
    set_factors(t, state);
    return state;
  }



  template <int dim>
  void
  MaterialField<dim>::convert(const Conversion conversion, Vector &r) const
  {
    using Field = QuadratureField<dim>;
    if (!law.hardens())
      return;
    const auto creep = at(0.).creep;
    for (std::size_t p = 0; p < n_points; ++p)
      {
        const std::size_t place = p * Field::n_components;
        Field::set(r, place, ((*creep)[p].*conversion)(Field::get(r, place)));
      }
  }



  template class MaterialField<2>;
  template class MaterialField<3>;
} // namespace Crevasse
