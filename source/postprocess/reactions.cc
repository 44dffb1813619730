// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/postprocess/reactions.h>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  Reactions<dim>::Reactions(const Body<dim> &body, const LoadParameters &loads)
    : body(body)
    , loads(loads)
    , volume_forces(components_in_volume(loads))
    , ids(body.space.roles.displaced.begin(), body.space.roles.displaced.end())
  {
    const BoundaryRoles &roles = body.space.roles;
    ids.insert(ids.end(), roles.clamped.begin(), roles.clamped.end());
    typename NodalFunctions<dim>::Numbers numbers;
    for (unsigned int b = 0; b < ids.size(); ++b)
      for (unsigned int d = 0; d < dim; ++d)
        for (const auto &[dof, point] : nodes_on(body.space, ids[b], d))
          numbers.emplace(dof, b * dim + d);
    const NodalFunctions<dim> functions(body.space, numbers);
    CellValues<dim>           cell_values(body.space,
                                update_values | update_gradients |
                                  update_quadrature_points | update_JxW_values);
    functions.for_each_part([&](const unsigned int column,
                                const double       part,
                                const unsigned int i,
                                const auto        &cell) {
      const FEValues<dim> &values   = cell_values.reinit(cell);
      const auto           of_shape = functions.strains_of_shape(i, values);
      for (const unsigned int q : values.quadrature_point_indices())
        of_stress.push_back({(body.points.first_point(cell) + q) *
                               QuadratureField<dim>::n_components,
                             column,
                             part * values.JxW(q) * of_shape[q]});
    });
    find_loads(functions);
  }



  template <int dim>
  void
  Reactions<dim>::find_loads(const NodalFunctions<dim> &functions)
  {
    const Space<dim> &space = body.space;
    const UpdateFlags flags =
      update_values | update_quadrature_points | update_JxW_values;
    CellValues<dim>   cell_values(space, flags);
    FEFaceValues<dim> face_values(space.mapping,
                                  space.finite_element,
                                  space.face_quadrature(),
                                  flags | update_normal_vectors);
    functions.for_each_part([&](const unsigned int column,
                                const double       part,
                                const unsigned int i,
                                const auto        &cell) {
      const unsigned int component =
        space.finite_element.system_to_component_index(i).first;
      const auto add = [&](const FEValuesBase<dim> &values,
                           const types::boundary_id id) {
        for (const unsigned int q : values.quadrature_point_indices())
          {
            LoadedPoint point{column, id, values.quadrature_point(q), {}, {}};
            if (id != numbers::invalid_boundary_id)
              point.normal = values.normal_vector(q);
            point.share[component] =
              part * values.shape_value(i, q) * values.JxW(q);
            loaded.push_back(point);
          }
      };
      if (!volume_forces.empty())
        add(cell_values.reinit(cell), numbers::invalid_boundary_id);
      for (const unsigned int f : cell->face_indices())
        if (const auto id = cell->face(f)->boundary_id();
            cell->at_boundary(f) && space.roles.loaded.count(id) > 0)
          {
            face_values.reinit(cell, f);
            add(face_values, id);
          }
    });
  }



  template <int dim>
  std::vector<std::string>
  Reactions<dim>::columns() const
  {
    std::vector<std::string> names;
    for (const auto id : ids)
      for (unsigned int d = 0; d < dim; ++d)
        names.push_back(std::string("F_") + "xyz"[d] + '_' +
                        std::to_string(id));
    return names;
  }



  template <int dim>
  std::vector<double>
  Reactions<dim>::forces(const Vector &stress, const double t) const
  {
    std::vector<double> sums(dim * ids.size());
    collectively(body.space.communicator(), [&]() {
      for (const auto &[offset, column, factor] : of_stress)
        sums[column] += factor * QuadratureField<dim>::get(stress, offset);
      for (const LoadedPoint &place : loaded)
        {
          Tensor<1, dim> force;
          if (place.id != numbers::invalid_boundary_id)
            force =
              surface_force<dim>(loads, place.id, place.point, place.normal, t);
          else
            for (const auto &[d, formula] : volume_forces)
              force[d] += formula.value(place.point, t);
          sums[place.column] -= place.share * force;
        }
    });
    Utilities::MPI::sum(sums, body.space.communicator(), sums);
    return sums;
  }



  template class Reactions<2>;
  template class Reactions<3>;
} // namespace Crevasse
