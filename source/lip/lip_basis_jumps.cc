// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// The jumps of LipBasis, along its tangents as unknowns.

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/lip/lip_basis.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Orthonormal tangents of a plane with a unit normal: (n₂, −n₁) in the
     * plane, so that both signs of n give the same sign of t·(u⁺ − u⁻). */
    template <int dim>
    std::array<Tensor<1, dim>, dim - 1>
    tangents_of(const Tensor<1, dim> &normal)
    {
      std::array<Tensor<1, dim>, dim - 1> tangents;
      if constexpr (dim == 2)
        tangents[0] = cross_product_2d(normal);
      else
        {
          const Tensor<1, dim> axis =
            Point<dim>::unit_vector(std::abs(normal[0]) < 0.6 ? 0 : 1);
          tangents[0] = axis - (axis * normal) * normal;
          tangents[0] /= tangents[0].norm();
          tangents[1] = cross_product_3d(normal, tangents[0]);
        }
      return tangents;
    }
  } // namespace



  template <int dim>
  typename LipBasis<dim>::Weights
  LipBasis<dim>::jump_along(const Tensor<1, dim> &direction,
                            const Node           &node,
                            const Meanings       &supported) const
  {
    Weights jump;
    for (const unsigned int side : {0, 1})
      for (unsigned int d = 0; d < dim; ++d)
        if (node.sides[side] != numbers::invalid_dof_index)
          add_expanded(node.sides[side] + d,
                       (side == 0 ? 1. : -1.) * direction[d],
                       supported,
                       jump);
    return jump;
  }



  template <int dim>
  void
  LipBasis<dim>::make_sliding(Node &node, const Meanings &supported)
  {
    node.tangents = tangents_of(node.normal);
    for (unsigned int c = 0; c < dim - 1; ++c)
      {
        const auto unknown =
          make_unknown(jump_along(node.tangents[c], node, supported), false);
        if (!unknown)
          throw SceneError(
            "[Boundary] Friction coefficient: at " +
            Text::from_point(node.point) +
            " lips meet whose slips depend on each other. Set the coefficient "
            "to 0, or end one of them there.");
        node.sliding[c] = unknown->first;
      }
  }



  template <int dim>
  std::vector<Tensor<1, dim>>
  LipBasis<dim>::jumps(const Vector &nodal_values) const
  {
    std::vector<double> all(nodes.size() * dim);
    for (unsigned int i = 0; i < all.size(); ++i)
      for (const unsigned int side : {0, 1})
        // A node's degrees of freedom are on one rank. The second side that is
        // missing at a rigid plane is on none.
        if (const auto first = nodes[i / dim].sides[side];
            nodal_values.in_local_range(first))
          all[i] += (side == 0 ? 1. : -1.) * nodal_values(first + i % dim);
    Utilities::MPI::sum(all, nodal_values.get_mpi_communicator(), all);
    std::vector<Tensor<1, dim>> jumps(nodes.size());
    for (unsigned int i = 0; i < all.size(); ++i)
      jumps[i / dim][i % dim] = all[i];
    return jumps;
  }



#define INSTANTIATE(dim)                                                    \
  template typename LipBasis<dim>::Weights LipBasis<dim>::jump_along(       \
    const Tensor<1, dim> &, const LipBasis<dim>::Node &, const Meanings &)  \
    const;                                                                  \
  template void LipBasis<dim>::make_sliding(LipBasis<dim>::Node &,          \
                                            const Meanings &);              \
  template std::vector<Tensor<1, dim>> LipBasis<dim>::jumps(const Vector &) \
    const

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
