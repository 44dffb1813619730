// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/discretisation/imposed_displacement.h>
#include <crevasse/discretisation/stiffness.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Formula of a component on a boundary; 0 if there is none. */
    Expression
    formula_on(const types::boundary_id id,
               const unsigned int       component,
               const LoadFormulas      &values)
    {
      const PlacedFormulas *const placed = placed_on(id, values);
      return placed != nullptr ? placed->components[component]
                               : Expression("0");
    }
  } // namespace



  template <int dim>
  ImposedDisplacement<dim>::ImposedDisplacement(
    const Space<dim>           &space,
    const QuadratureField<dim> &points,
    const LoadParameters       &loads)
    : is_on(!space.roles.displaced.empty())
    , communicator(space.communicator())
  {
    if (!is_on)
      return;
    typename NodalFunctions<dim>::Numbers numbers;
    for (const auto id : space.roles.displaced)
      for (unsigned int d = 0; d < dim; ++d)
        if (space.roles.free.count({id, d}) == 0)
          {
            const Expression value = formula_on(id, d, loads.displacement);
            const Expression rate  = formula_on(id, d, loads.displacement_rate);
            varies                 = varies || value.depends_on_time();
            flows                  = flows || !rate.is_zero();
            collectively(communicator, [&]() {
              for (const auto &[dof, point] : nodes_on(space, id, d))
                if (numbers.emplace(dof, nodes.size()).second)
                  {
                    nodes.push_back({point, value});
                    rates.push_back(rate.value(point));
                  }
            });
          }
    functions = std::make_unique<const NodalFunctions<dim>>(space, numbers);
    require_free_normals(space);
    require_straight_planes(space);
    find_strains(space, points);
  }



  template <int dim>
  void
  ImposedDisplacement<dim>::require_free_normals(const Space<dim> &space) const
  {
    collectively(communicator, [&]() {
      for (const auto &node : space.lip.nodes)
        for (const auto first : node.sides)
          for (unsigned int d = 0; d < dim; ++d)
            if (node.has_unknown() && first != numbers::invalid_dof_index &&
                node.normal[d] != 0. && functions->numbers.count(first + d) > 0)
              throw SceneError(
                "[Boundary] Displaced: at " + Text::from_point(node.point) +
                " it meets a lip whose normal is not along an axis, so that "
                "the displacement would open the lip. End the displaced "
                "boundary before the lip.");
    });
  }



  template <int dim>
  void
  ImposedDisplacement<dim>::require_straight_planes(
    const Space<dim> &space) const
  {
    const auto                          &fe = space.finite_element;
    FEFaceValues<dim>                    values(space.mapping,
                             fe,
                             QMidpoint<dim - 1>(),
                             update_normal_vectors);
    std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
    collectively(communicator, [&]() {
      for (const auto &cell : owned_cells(space.dof_handler))
        for (const unsigned int f : cell->face_indices())
          {
            if (!cell->at_boundary(f) ||
                space.roles.symmetry.count(cell->face(f)->boundary_id()) == 0)
              continue;
            values.reinit(cell, f);
            cell->get_dof_indices(dofs);
            double largest = 0.;
            for (unsigned int d = 0; d < dim; ++d)
              largest = std::max(largest, std::abs(values.normal_vector(0)[d]));
            for (unsigned int i = 0; largest < 1. - 1e-8 && i < dofs.size();
                 ++i)
              if (fe.has_support_on_face(i, f) &&
                  functions->numbers.count(dofs[i]) > 0)
                throw SceneError(
                  "[Boundary] Displaced: at " +
                  Text::from_point(cell->face(f)->center()) +
                  " it meets a plane of symmetry that is not across an axis. "
                  "Turn the mesh, so that this plane is x, y or z = const.");
          }
    });
  }



  template <int dim>
  void
  ImposedDisplacement<dim>::find_strains(const Space<dim>           &space,
                                         const QuadratureField<dim> &points)
  {
    ShapeStrains<dim>             shapes(space);
    std::vector<VoigtVector<dim>> of_shapes;
    functions->for_each_cell([&](const auto &cell, const auto &parts) {
      const FEValues<dim> &values = shapes.reinit(cell);
      for (const unsigned int q : values.quadrature_point_indices())
        {
          shapes.at_point(q, of_shapes);
          for (const auto &[i, node, factor] : parts)
            strains.push_back(
              {points.first_point(cell) + q, node, factor * of_shapes[i]});
        }
    });
    for (const auto dof : space.dof_handler.locally_owned_dofs())
      if (const auto parts = functions->parts_of(dof); !parts.empty())
        places.emplace_back(dof, parts);
  }



  template <int dim>
  typename ImposedDisplacement<dim>::Values
  ImposedDisplacement<dim>::values(const double t, const double time) const
  {
    Values all;
    collectively(communicator, [&]() {
      for (unsigned int k = 0; k < nodes.size(); ++k)
        all.push_back(value(k, t, time));
    });
    return all;
  }



  template <int dim>
  void
  ImposedDisplacement<dim>::add_strains(
    const Values                  &values,
    const double                   factor,
    std::vector<VoigtVector<dim>> &strains) const
  {
    for (const auto &[point, node, strain] : this->strains)
      strains[point] += factor * values[node] * strain;
  }



  template <int dim>
  void
  ImposedDisplacement<dim>::add_values(const Values &values,
                                       Vector       &nodal) const
  {
    nodal.zero_out_ghost_values();
    for (const auto &[dof, parts] : places)
      for (const auto &[node, part] : parts)
        nodal(dof) += part * values[node];
    nodal.update_ghost_values();
  }



  template <int dim>
  double
  ImposedDisplacement<dim>::value(
    const typename NodalFunctions<dim>::Parts &parts,
    const double                               t,
    const double                               time) const
  {
    double sum = 0.;
    for (const auto &[node, factor] : parts)
      sum += factor * value(node, t, time);
    return sum;
  }



  template <int dim>
  double
  ImposedDisplacement<dim>::rate(
    const typename NodalFunctions<dim>::Parts &parts) const
  {
    double sum = 0.;
    for (const auto &[node, factor] : parts)
      sum += factor * rates[node];
    return sum;
  }



  template class ImposedDisplacement<2>;
  template class ImposedDisplacement<3>;
} // namespace Crevasse
