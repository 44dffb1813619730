// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/grid/mesh.h>
#include <crevasse/lip/contact_boundary.h>

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
  ContactBoundary<dim>::ContactBoundary(const LipBasis<dim>   &basis,
                                        const DoFHandler<dim> &dof_handler,
                                        const IndexSet        &owned_unknowns,
                                        Expression           &&gap_formula)
    : basis(basis)
    , dof_handler(dof_handler)
    , gap(std::move(gap_formula))
    , rounding(rounding_of_coordinates<dim>(dof_handler.get_triangulation()))
  {
    const auto &all = basis.nodes;

    std::map<types::global_dof_index, unsigned int> n_at;
    for (unsigned int i = 0; i < all.size(); ++i)
      {
        const auto  &node      = all[i];
        const double gap_there = gap_at(node.point);
        has_gap = has_gap || (node.has_unknown() && gap_there != 0.);
        if (node.has_unknown() && owned_unknowns.is_element(node.unknown))
          nodes.push_back({node, i, gap_there});
        Place place;
        if (node.weight > 0.)
          place.masters.emplace_back(i, 1.);
        place.masters.insert(place.masters.end(),
                             node.masters.begin(),
                             node.masters.end());
        for (const auto first :
             std::set<types::global_dof_index>(node.sides.begin(),
                                               node.sides.end()))
          if (first != numbers::invalid_dof_index)
            {
              place.dof = first + node.component();
              if (owned_unknowns.is_element(place.dof))
                {
                  places.push_back(place);
                  ++n_at[place.dof];
                }
            }
      }
    for (Place &place : places)
      for (auto &[number, factor] : place.masters)
        factor /= n_at[place.dof];
    std::sort(nodes.begin(),
              nodes.end(),
              [](const LipNode<dim> &a, const LipNode<dim> &b) {
                return a.unknown < b.unknown;
              });
  }



  template <int dim>
  std::vector<PairState>
  ContactBoundary<dim>::states(const Vector        &displacement,
                               const ContactForces &contact_forces) const
  {
    const double        touching = 1e-10 * displacement.linfty_norm();
    std::vector<double> openings(basis.nodes.size()), pressed(openings),
      pressures(openings); // negative if open
    for (unsigned int k = 0; k < nodes.size(); ++k)
      {
        const LipNode<dim> &node    = nodes[k];
        const double        force   = contact_forces.normal[k];
        double             &opening = openings[node.number];
        opening                     = node.normal_part(displacement) - node.gap;
        const bool is_pressed = force > negligible_force && opening <= touching;
        pressed[node.number]  = is_pressed ? 1. : 0.;
        if (node.weight > 0.)
          pressures[node.number] =
            (is_pressed ? force : -std::abs(force)) / node.weight;
      }
    for (std::vector<double> *values : {&openings, &pressed, &pressures})
      Utilities::MPI::sum(*values, dof_handler.get_communicator(), *values);
    std::vector<PairState> all(basis.nodes.size());
    for (unsigned int i = 0; i < all.size(); ++i)
      if (const auto &node = basis.nodes[i]; node.has_unknown())
        {
          const bool   has_own = node.weight > 0. || node.masters.empty();
          const double pressure =
            pressures[has_own ? i : node.masters.front().first];
          all[i] = {openings[i],
                    std::abs(pressure),
                    pressed[i] > 0. || pressure > 0.};
        }
    return all;
  }



  template <int dim>
  LipTotals
  ContactBoundary<dim>::totals(const Vector        &displacement,
                               const ContactForces &contact_forces) const
  {
    LipTotals totals;
    totals.force = force(contact_forces);
    for (const PairState &pair : states(displacement, contact_forces))
      {
        totals.closed_nodes += pair.is_closed ? 1 : 0;
        totals.largest_pressure =
          std::max(totals.largest_pressure, pair.pressure);
        totals.largest_opening = std::max(totals.largest_opening, pair.opening);
      }
    return totals;
  }



  template <int dim>
  double
  ContactBoundary<dim>::force(const ContactForces &contact_forces) const
  {
    double sum = 0.;
    for (unsigned int k = 0; k < nodes.size(); ++k)
      sum += nodes[k].force(contact_forces.normal[k]);
    return Utilities::MPI::sum(sum, dof_handler.get_communicator());
  }



  template <int dim>
  std::vector<double>
  ContactBoundary<dim>::opening_rates(const Vector &velocity) const
  {
    const double opens = 1e-10 * velocity.linfty_norm(); // beyond rounding
    std::vector<double> rates(basis.nodes.size());
    for (const LipNode<dim> &node : nodes)
      if (const double rate = node.normal_part(velocity); rate > opens)
        rates[node.number] = rate;
    Utilities::MPI::sum(rates, dof_handler.get_communicator(), rates);
    return rates;
  }



  template <int dim>
  Vector
  ContactBoundary<dim>::pressure(const ContactForces &contact_forces) const
  {
    std::vector<double> at_nodes(basis.nodes.size());
    for (unsigned int k = 0; k < nodes.size(); ++k)
      if (nodes[k].weight > 0.)
        at_nodes[nodes[k].number] = contact_forces.normal[k] / nodes[k].weight;
    Utilities::MPI::sum(at_nodes, dof_handler.get_communicator(), at_nodes);
    Vector values = make_vector(dof_handler);
    for (const Place &place : places)
      for (const auto &[number, factor] : place.masters)
        values(place.dof) += factor * at_nodes[number];
    values.update_ghost_values();
    return values;
  }



  template <int dim>
  Vector
  ContactBoundary<dim>::opening(const Vector &nodal_values) const
  {
    const auto jumps  = basis.jumps(nodal_values);
    Vector     values = make_vector(dof_handler);
    for (unsigned int i = 0; i < jumps.size(); ++i)
      for (const auto first : basis.nodes[i].sides)
        if (first != numbers::invalid_dof_index && values.in_local_range(first))
          {
            const auto  &node    = basis.nodes[i];
            const double opening = jumps[i] * node.normal - gap_at(node.point);
            double      &value   = values(first + node.component());
            value = value == 0. ? opening : std::min(value, opening);
          }
    values.update_ghost_values();
    return values;
  }



  template <int dim>
  std::vector<double>
  ContactBoundary<dim>::of_contact_forces(Vector &weights) const
  {
    weights.compress(VectorOperation::add);
    std::vector<double> at_nodes(basis.nodes.size());
    for (const Place &place : places)
      for (const auto &[number, factor] : place.masters)
        at_nodes[number] += factor * weights(place.dof);
    Utilities::MPI::sum(at_nodes, dof_handler.get_communicator(), at_nodes);
    std::vector<double> factors;
    for (const LipNode<dim> &node : nodes)
      factors.push_back(node.weight > 0. ? at_nodes[node.number] / node.weight
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
