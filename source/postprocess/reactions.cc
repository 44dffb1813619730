// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/discretisation/stiffness.h>
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
    const NodalFunctions<dim>     functions(body.space, numbers);
    ShapeStrains<dim>             shapes(body.space);
    std::vector<VoigtVector<dim>> of_shapes;
    functions.for_each_cell([&](const auto &cell, const auto &parts) {
      const FEValues<dim> &values = shapes.reinit(cell);
      for (const unsigned int q : values.quadrature_point_indices())
        {
          shapes.at_point(q, of_shapes);
          for (const auto &[i, column, part] : parts)
            of_stress.push_back({(body.points.first_point(cell) + q) *
                                   QuadratureField<dim>::n_components,
                                 column,
                                 part * values.JxW(q) * of_shapes[i]});
        }
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
    functions.for_each_cell([&](const auto &cell, const auto &parts) {
      const auto add = [&](const FEValuesBase<dim> &values,
                           const types::boundary_id id) {
        for (const unsigned int q : values.quadrature_point_indices())
          {
            LoadedPoint point{id, values.quadrature_point(q), {}, {}};
            if (id != numbers::invalid_boundary_id)
              point.normal = values.normal_vector(q);
            for (const auto &[i, column, part] : parts)
              {
                const unsigned int component =
                  space.finite_element.system_to_component_index(i).first;
                point.shares.push_back(
                  {column,
                   component,
                   part * values.shape_value(i, q) * values.JxW(q)});
              }
            loaded.push_back(std::move(point));
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
          for (const auto &[column, component, share] : place.shares)
            sums[column] -= share * force[component];
        }
    });
    Utilities::MPI::sum(sums, body.space.communicator(), sums);
    return sums;
  }



  template class Reactions<2>;
  template class Reactions<3>;
} // namespace Crevasse
