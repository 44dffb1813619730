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
    /** Rounding error of coordinates of the body. */
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
    std::map<types::global_dof_index, unsigned int> n_at;
    for (unsigned int i = 0; i < all.size(); ++i)
      {
        const auto  &node      = all[i];
        const double gap_there = gap_at(node.point);
        Place        place;
        if (node.weight > 0.)
          place.masters.emplace_back(node.unknown, 1.);
        for (const auto &[number, factor] : node.masters)
          place.masters.emplace_back(all[number].unknown, factor);
        if (node.has_unknown() && owned.is_element(node.unknown))
          nodes.push_back({node.unknown,
                           node.sign,
                           gap_there,
                           node.weight,
                           node.area,
                           place.masters.empty() ? numbers::invalid_dof_index
                                                 : place.masters[0].first,
                           node.point,
                           i,
                           node.normal});
        for (const auto first :
             std::set<types::global_dof_index>(node.sides.begin(),
                                               node.sides.end()))
          if (first != numbers::invalid_dof_index)
            {
              place.dof = first + node.component();
              if (owned.is_element(place.dof))
                {
                  places.push_back(place);
                  ++n_at[place.dof];
                }
            }
      }
    for (Place &place : places)
      for (auto &[unknown, factor] : place.masters)
        factor /= n_at[place.dof];
    std::sort(nodes.begin(),
              nodes.end(),
              [](const LipNode<dim> &a, const LipNode<dim> &b) {
                return a.dof < b.dof;
              });
  }



  template <int dim>
  std::vector<LipNodeState>
  ContactBoundary<dim>::states(const Vector              &displacement,
                               const std::vector<double> &contact_forces) const
  {
    const double touching  = 1e-10 * displacement.linfty_norm();
    Vector       pressures = space.ghosted_vector(); // negative if open
    std::vector<LipNodeState> all;
    for (unsigned int k = 0; k < nodes.size(); ++k)
      {
        const LipNode<dim> &node  = nodes[k];
        const double        force = contact_forces[k],
                     opening      = node.opening(displacement);
        const bool is_pressed = force > negligible_force && opening <= touching;
        all.push_back({opening, 0., is_pressed});
        if (node.weight > 0.)
          pressures(node.dof) =
            (is_pressed ? force : -std::abs(force)) / node.weight;
      }
    pressures.update_ghost_values();
    for (unsigned int k = 0; k < nodes.size(); ++k)
      if (nodes[k].source != numbers::invalid_dof_index)
        {
          const double value = pressures(nodes[k].source);
          all[k].pressure    = std::abs(value);
          all[k].is_closed   = all[k].is_closed || value > 0.;
        }
    return all;
  }



  template <int dim>
  Vector
  ContactBoundary<dim>::pressure(
    const std::vector<double> &contact_forces) const
  {
    Vector at_unknowns = space.ghosted_vector();
    for (unsigned int k = 0; k < nodes.size(); ++k)
      if (nodes[k].weight > 0.)
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
      factors.push_back(node.weight > 0. ? at_unknowns(node.dof) / node.weight
                                         : 0.);
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
