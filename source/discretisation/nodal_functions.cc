// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/nodal_functions.h>

#include <deal.II/numerics/vector_tools.h>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  std::map<types::global_dof_index, Point<dim>>
  nodes_on(const Space<dim>        &space,
           const types::boundary_id id,
           const unsigned int       component)
  {
    ComponentMask mask(dim, false);
    mask.set(component, true);
    std::map<types::global_dof_index, Point<dim>> points;
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        const VectorFunctionFromScalarFunctionObject<dim> coordinate(
          [axis](const Point<dim> &point) { return point[axis]; },
          component,
          dim);
        std::map<types::global_dof_index, double> coordinates;
        VectorTools::interpolate_boundary_values(
          space.mapping, space.dof_handler, id, coordinate, coordinates, mask);
        for (const auto &[dof, coordinate] : coordinates)
          points[dof][axis] = coordinate;
      }
    return points;
  }



  template <int dim>
  NodalFunctions<dim>::NodalFunctions(const Space<dim> &space,
                                      const Numbers    &numbers)
    : space(space)
    , numbers(numbers)
    , hanging(DoFTools::extract_locally_relevant_dofs(space.dof_handler))
  {
    DoFTools::make_hanging_node_constraints(space.dof_handler, hanging);
    hanging.close();
  }



  template <int dim>
  typename NodalFunctions<dim>::Parts
  NodalFunctions<dim>::parts_of(const types::global_dof_index dof) const
  {
    if (const auto own = numbers.find(dof); own != numbers.end())
      return {{own->second, 1.}};
    Parts parts;
    if (const auto *masters = hanging.get_constraint_entries(dof))
      for (const auto &[master, factor] : *masters)
        if (const auto own = numbers.find(master); own != numbers.end())
          parts.emplace_back(own->second, factor);
    return parts;
  }



  template decltype(nodes_on<2>) nodes_on<2>;
  template decltype(nodes_on<3>) nodes_on<3>;
  template class NodalFunctions<2>;
  template class NodalFunctions<3>;
} // namespace Crevasse
