// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/postprocess/lip_opening.h>

#include <deal.II/base/mpi.h>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  std::vector<Tensor<1, dim>>
  lip_jumps(const Space<dim> &space, const Vector &displacement)
  {
    const auto         &nodes = space.lip.nodes;
    std::vector<double> all(nodes.size() * dim);
    for (unsigned int i = 0; i < all.size(); ++i)
      for (const unsigned int side : {0, 1})
        // A node's degrees of freedom are on one rank. At a rigid plane a node
        // has one side.
        if (const auto first = nodes[i / dim].sides[side];
            first != numbers::invalid_dof_index &&
            displacement.in_local_range(first))
          all[i] += (side == 0 ? 1. : -1.) * displacement(first + i % dim);
    Utilities::MPI::sum(all, space.communicator(), all);
    std::vector<Tensor<1, dim>> jumps(nodes.size());
    for (unsigned int i = 0; i < all.size(); ++i)
      jumps[i / dim][i % dim] = all[i];
    return jumps;
  }



  template <int dim>
  Vector
  lip_opening(const Space<dim>           &space,
              const ContactBoundary<dim> &lip,
              const Vector               &displacement)
  {
    const auto jumps   = lip_jumps(space, displacement);
    Vector     at_dofs = make_vector(space.dof_handler);
    for (unsigned int i = 0; i < jumps.size(); ++i)
      for (const auto first : space.lip.nodes[i].sides)
        if (first != numbers::invalid_dof_index &&
            at_dofs.in_local_range(first))
          {
            const auto  &node = space.lip.nodes[i];
            const double opening =
              jumps[i] * node.normal - lip.gap_at(node.point);
            double &value = at_dofs(first + node.component());
            value         = value == 0. ? opening : std::min(value, opening);
          }
    at_dofs.update_ghost_values();
    return at_dofs;
  }



  template std::vector<Tensor<1, 2>>
  lip_jumps(const Space<2> &, const Vector &);
  template std::vector<Tensor<1, 3>>
  lip_jumps(const Space<3> &, const Vector &);
  template Vector
  lip_opening(const Space<2> &, const ContactBoundary<2> &, const Vector &);
  template Vector
  lip_opening(const Space<3> &, const ContactBoundary<3> &, const Vector &);
} // namespace Crevasse
