// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/postprocess/lip_opening.h>

#include <deal.II/base/mpi.h>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  Vector
  lip_opening(const Space<dim>           &space,
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
    return at_dofs;
  }



  template Vector
  lip_opening(const Space<2> &, const ContactBoundary<2> &, const Vector &);
  template Vector
  lip_opening(const Space<3> &, const ContactBoundary<3> &, const Vector &);
} // namespace Crevasse
