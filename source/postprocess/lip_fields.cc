// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/postprocess/lip_fields.h>

#include <deal.II/base/mpi.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** What lip nodes have in one of their degrees of freedom, with zeros in
     * the others, as a scalar at the nodes. */
    template <int dim>
    Vector
    scalar_of_lip(const Space<dim>          &space,
                  const StressRecovery<dim> &recovery,
                  const Vector              &at_dofs)
    {
      Vector               values = make_vector(recovery.dof_handler);
      const FESystem<dim> &fe     = space.finite_element;
      std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
      std::vector<types::global_dof_index> nodes(dofs.size() / dim);
      for (const auto &cell : owned_cells(recovery.dof_handler))
        {
          cell->get_dof_indices(nodes);
          same_cell(cell->id(), space.dof_handler)->get_dof_indices(dofs);
          for (unsigned int i = 0; i < dofs.size(); ++i)
            if (const auto node = nodes[fe.system_to_component_index(i).second];
                at_dofs(dofs[i]) != 0. && values.in_local_range(node))
              values(node) = at_dofs(dofs[i]);
        }
      values.update_ghost_values();
      return values;
    }
  } // namespace



  template <int dim>
  Vector
  contact_pressure(const Space<dim>           &space,
                   const StressRecovery<dim>  &recovery,
                   const ContactBoundary<dim> &lip,
                   const std::vector<double>  &contact_forces)
  {
    return scalar_of_lip(space, recovery, lip.pressure(contact_forces));
  }



  template <int dim>
  Vector
  lip_opening(const Space<dim>           &space,
              const StressRecovery<dim>  &recovery,
              const ContactBoundary<dim> &lip,
              const Vector               &displacement)
  {
    const auto         &nodes = space.lip.nodes;
    std::vector<double> openings(nodes.size());
    Vector              at_dofs = make_vector(space.dof_handler);
    // Those of a node are on one rank. Before a rigid plane it has one side.
    const auto is_here = [&at_dofs](const types::global_dof_index first) {
      return first != numbers::invalid_dof_index &&
             at_dofs.in_local_range(first);
    };
    for (unsigned int i = 0; i < nodes.size(); ++i)
      for (const unsigned int side : {0, 1})
        if (const auto first = nodes[i].sides[side]; is_here(first))
          for (unsigned int d = 0; d < dim; ++d)
            openings[i] += (side == 0 ? 1. : -1.) * nodes[i].normal[d] *
                           displacement(first + d);
    Utilities::MPI::sum(openings, space.communicator(), openings);
    for (unsigned int i = 0; i < nodes.size(); ++i)
      for (const auto first : nodes[i].sides)
        if (is_here(first))
          {
            const double opening = openings[i] - lip.gap_at(nodes[i].point);
            double      &value   = at_dofs(first + nodes[i].component());
            value = value == 0. ? opening : std::min(value, opening);
          }
    at_dofs.update_ghost_values();
    return scalar_of_lip(space, recovery, at_dofs);
  }



  template Vector
  contact_pressure<2>(const Space<2> &,
                      const StressRecovery<2> &,
                      const ContactBoundary<2> &,
                      const std::vector<double> &);
  template Vector
  contact_pressure<3>(const Space<3> &,
                      const StressRecovery<3> &,
                      const ContactBoundary<3> &,
                      const std::vector<double> &);
  template Vector
  lip_opening<2>(const Space<2> &,
                 const StressRecovery<2> &,
                 const ContactBoundary<2> &,
                 const Vector &);
  template Vector
  lip_opening<3>(const Space<3> &,
                 const StressRecovery<3> &,
                 const ContactBoundary<3> &,
                 const Vector &);
} // namespace Crevasse
