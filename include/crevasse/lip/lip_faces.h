// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_lip_lip_faces_h
#define crevasse_lip_lip_faces_h

#include <crevasse/parameters/boundary_roles.h>

#include <deal.II/base/quadrature.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>

#include <array>
#include <vector>

namespace Crevasse
{
  /** Face of the lips, with the contributions of its nodes. */
  template <int dim>
  struct LipFace
  {
    struct Node
    {
      dealii::types::global_dof_index first; ///< first degree of freedom
      dealii::Point<dim>              point;
      double                          area; ///< area ∫φ over the face
      dealii::Tensor<1, dim>          load; ///< load ∫φ n, n into the body
      /** Load, or on an axis, where it vanishes for quadratic φ, load without
       * the factor r. */
      dealii::Tensor<1, dim> inward;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &first &point &area &load &inward;
      }
    };

    /** Id of the cell and number of the face, which do not depend on the number
     * of ranks. */
    std::array<unsigned int, 5> id;
    dealii::Point<dim>          centre;
    double                      size;
    bool                        is_crack; ///< whether it has a partner
    std::vector<Node>           nodes;

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &id &centre &size &is_crack &nodes;
    }

    /** Node at a point, or null. */
    const Node *
    node_at(const dealii::Point<dim> &point) const
    {
      for (const Node &node : nodes)
        if (node.point.distance(point) < tolerance * size)
          return &node;
      return nullptr;
    }

    /** Tolerance of coordinates in files, relative to the size of a face. */
    static constexpr double tolerance = 1e-6;
  };

  /** Active faces of the lips on all ranks, in the order of their ids.
   * Collective. @param rule Quadrature on faces. */
  template <int dim>
  std::vector<LipFace<dim>>
  find_lip_faces(const dealii::DoFHandler<dim>     &dof_handler,
                 const dealii::Mapping<dim>        &mapping,
                 const dealii::Quadrature<dim - 1> &rule,
                 const BoundaryRoles               &roles);

  /** Pairs of coinciding points: for each point the number of its partner, or
   * its own if there is none.
   * @param sizes Sizes within a millionth of which points coincide. */
  template <int dim>
  std::vector<unsigned int>
  find_partners(const std::vector<dealii::Point<dim>> &points,
                const std::vector<double>             &sizes);
} // namespace Crevasse

#endif
