// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/discretisation/contact_boundary.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** What coordinates of the body round to. */
    template <int dim>
    double
    rounding_of_coordinates(const Triangulation<dim> &mesh)
    {
      const BoundingBox<dim> box     = GridTools::compute_bounding_box(mesh);
      const auto            &corners = box.get_boundary_points();
      return 1e-15 * (corners.first.norm() + corners.second.norm());
    }
  } // namespace



  template <int dim>
  ContactBoundary<dim>::ContactBoundary(const Space<dim> &space,
                                        Expression      &&gap_formula)
    : space(space)
    , gap(std::move(gap_formula))
    , rounding(rounding_of_coordinates<dim>(space.mesh()))
  {
    const auto &all   = space.lip.nodes;
    const auto &owned = space.locally_owned_unknowns;
    // Of a body of revolution, on the axis and of degree 2: the pressure there
    // is that of the nearest other node.
    const auto has_no_share = [&](const auto &node) {
      return space.roles.has_axis && space.finite_element.degree == 2 &&
             node.point[0] < 1e6 * rounding;
    };
    const auto nearest_with_share = [&](const auto &node) {
      auto nearest = node;
      for (const auto &other : all)
        if (other.has_unknown() && !has_no_share(other) &&
            (has_no_share(nearest) || other.point.distance(node.point) <
                                        nearest.point.distance(node.point)))
          nearest = other;
      return nearest;
    };
    for (const auto &node : all)
      {
        const double gap_there = gap_at(node.point);
        if (node.has_unknown() && owned.is_element(node.unknown))
          nodes.push_back({node.unknown,
                           node.sign,
                           gap_there,
                           node.weight,
                           node.held_weight,
                           node.point,
                           node.normal});
        Place place;
        if (node.has_unknown())
          place.masters.emplace_back(
            (has_no_share(node) ? nearest_with_share(node) : node).unknown, 1.);
        for (const auto &[number, factor] : node.masters)
          place.masters.emplace_back(all[number].unknown, factor);
        for (const auto first :
             std::set<types::global_dof_index>(node.sides.begin(),
                                               node.sides.end()))
          if (first != numbers::invalid_dof_index)
            {
              place.dof = first + node.component();
              if (owned.is_element(place.dof))
                places.push_back(place);
            }
      }
    std::sort(nodes.begin(),
              nodes.end(),
              [](const LipNode<dim> &a, const LipNode<dim> &b) {
                return a.dof < b.dof;
              });
  }



  template <int dim>
  Vector
  ContactBoundary<dim>::pressure(
    const std::vector<double> &contact_forces) const
  {
    Vector at_unknowns = space.ghosted_vector();
    for (unsigned int k = 0; k < nodes.size(); ++k)
      at_unknowns(nodes[k].dof) = contact_forces[k] / nodes[k].weight;
    at_unknowns.update_ghost_values();
    Vector values = make_vector(space.dof_handler);
    for (const Place &place : places)
      for (const auto &[unknown, factor] : place.masters)
        values(place.dof) += factor * at_unknowns(unknown);
    values.update_ghost_values();
    return values;
  }



  template <int dim>
  std::vector<double>
  ContactBoundary<dim>::of_contact_forces(Vector &weights) const
  {
    weights.compress(VectorOperation::add);
    Vector at_unknowns = space.ghosted_vector();
    for (const Place &place : places)
      for (const auto &[unknown, factor] : place.masters)
        at_unknowns(unknown) += factor * weights(place.dof);
    at_unknowns.compress(VectorOperation::add);
    std::vector<double> factors;
    for (const LipNode<dim> &node : nodes)
      factors.push_back(at_unknowns(node.dof) / node.weight);
    return factors;
  }



  template <int dim>
  double
  ContactBoundary<dim>::gap_at(const Point<dim> &point) const
  {
    const double value = gap.value(point);
    if (value > rounding)
      throw SceneError("[Boundary] Gap = " + gap.formula() + ": is " +
                       Text::from_number(value, 6) + " at " +
                       Text::from_point(point) +
                       "; it must be at most 0 (an initial opening is "
                       "negative).");
    return std::min(value, 0.);
  }



  template class ContactBoundary<2>;
  template class ContactBoundary<3>;
} // namespace Crevasse
