// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_lip_lip_basis_h
#define crevasse_lip_lip_basis_h

#include <crevasse/base/vector.h>
#include <crevasse/lip/lip_faces.h>
#include <crevasse/lip/opening_unknowns.h>

#include <deal.II/lac/affine_constraints.h>

namespace Crevasse
{
  /**
   * Nodes of the lips, and a basis in which the opening of each node is an
   * unknown, so that contact bounds single unknowns.
   *
   * The opening is n·(u⁺ − u⁻), or n·u at a rigid plane. If it is not a degree
   * of freedom, it becomes one of OpeningUnknowns. Constraints express this, so
   * that no other code needs to know.
   *
   * All ranks know the whole basis, so that none needs the cells at the other
   * lip, and it does not depend on the number of ranks.
   */
  template <int dim>
  class LipBasis : public OpeningUnknowns
  {
  public:
    struct Node
    {
      dealii::Point<dim>     point;
      dealii::Tensor<1, dim> normal; ///< unit normal into the first side's body
      /** First degrees of freedom on both sides; equal at a tip, the second
       * invalid at a rigid plane. */
      std::array<Index, 2> sides;
      /** Unknown: opening = sign × unknown. Invalid if the node is fixed by
       * supports, shared by both lips, or a hanging node. */
      Index  unknown = dealii::numbers::invalid_dof_index;
      double sign    = 1.;
      /** With friction, orthonormal tangents t, so that t·(u⁺ − u⁻) is the
       * unknown in `sliding`: invalid if supports fix it, or if the node has no
       * unknown. */
      std::array<dealii::Tensor<1, dim>, dim - 1> tangents;
      std::array<Index, dim - 1>                  sliding;
      /** Contact force under a uniform pressure 1: the part of ∫φ n along the
       * normal, with the share of hanging nodes; less than ∫φ at a kink. 0 if
       * the node has no unknown, or if the weight is too small to compute a
       * pressure from the force, as for quadratic φ on an axis. */
      double weight = 0.;
      /** Area ∫φ over one lip, with the shares of nodes that take their
       * pressure from this node. */
      double area = 0.;
      /** Numbers and factors of the nodes whose pressures a node without weight
       * takes. */
      std::vector<std::pair<unsigned int, double>> masters;
      /** Number of the lip, a connected set of faces. */
      unsigned int lip = 0;

      Node()
      {
        sliding.fill(dealii::numbers::invalid_dof_index);
      }

      bool
      has_unknown() const
      {
        return unknown != dealii::numbers::invalid_dof_index;
      }

      /** Component whose direction is nearest to the normal; the first of
       * equals, so that neither rounding nor mesh decides. */
      unsigned int
      component() const
      {
        unsigned int largest = 0;
        for (unsigned int d = 1; d < dim; ++d)
          if (std::abs(normal[d]) > (1. + 1e-8) * std::abs(normal[largest]))
            largest = d;
        return largest;
      }
    };

    LipBasis() = default;

    /**
     * Collective.
     *
     * @param face_rule Quadrature on faces.
     * @param supports Closed constraints of supports and hanging nodes.
     * @throw SceneError if a face of a crack has no partner, or an opening
     * depends on others.
     */
    LipBasis(const dealii::DoFHandler<dim>           &dof_handler,
             const dealii::Mapping<dim>              &mapping,
             const dealii::Quadrature<dim - 1>       &face_rule,
             const BoundaryRoles                     &roles,
             const dealii::AffineConstraints<double> &supports);

    /** Displacement jump at each node: of its first side relative to the other
     * side, or to a rigid plane. Collective.
     * @param nodal_values Space::nodal_values() */
    std::vector<dealii::Tensor<1, dim>>
    jumps(const Vector &nodal_values) const;

    std::vector<Node> nodes;
    /** Numbers of the nodes on each face of the lips. */
    std::vector<std::vector<unsigned int>> nodes_of_faces;

    /** Whether tangential jumps are unknowns, too. */
    bool has_friction = false;

  private:
    struct Surroundings;

    Surroundings
    collect_nodes(const std::vector<LipFace<dim>> &faces);

    /** Number of the node on these sides; adds it if new. @param inward Inward
     * normal of the face, reversed if the sides are swapped. */
    unsigned int
    node_number(const typename LipFace<dim>::Node &node,
                const Index                        other_side,
                dealii::Tensor<1, dim>            &inward,
                Surroundings                      &surroundings);

    /** Constraints of supports at the nodes, on all ranks. */
    Meanings
    gather_supports(const dealii::DoFHandler<dim>           &dof_handler,
                    const dealii::AffineConstraints<double> &supports) const;

    /** Whether a node is a hanging node; then sets its masters. */
    bool
    hangs(Node &node, const Surroundings &surroundings) const;

    void
    make_opening(Node &node, const Meanings &supported);

    /** Makes the tangential jumps unknowns, after all openings. */
    void
    make_sliding(Node &node, const Meanings &supported);

    /** The jump along a direction as a function of degrees of freedom. */
    Weights
    jump_along(const dealii::Tensor<1, dim> &direction,
               const Node                   &node,
               const Meanings               &supported) const;

    /** Sets the weights of nodes, with the loads of hanging nodes. */
    void
    set_weights(Surroundings &surroundings);

    /** Chooses masters of nodes without weight. */
    void
    choose_masters();

    void
    number_lips(const Surroundings &surroundings);
  };
} // namespace Crevasse

#endif
