// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_lip_basis_h
#define crevasse_discretisation_lip_basis_h

#include <crevasse/discretisation/lip_faces.h>
#include <crevasse/discretisation/opening_unknowns.h>

#include <deal.II/lac/affine_constraints.h>

namespace Crevasse
{
  /**
   * The nodes of the lips, and a basis in which the opening of each is an
   * unknown, so that contact bounds single unknowns.
   *
   * The opening is n·(u⁺ − u⁻), or n·u before a rigid plane. If it is a degree
   * of freedom, nothing changes. Else it becomes one of OpeningUnknowns.
   * Constraints say so, and nothing else has to know.
   *
   * All ranks know all of it, so that none needs the other lip's cells, and it
   * does not depend on their number.
   */
  template <int dim>
  class LipBasis : public OpeningUnknowns
  {
  public:
    struct Node
    {
      dealii::Point<dim>     point;
      dealii::Tensor<1, dim> normal; ///< unit, into the body of the first side
      /** The first degrees of freedom on both sides; the same twice at a tip,
       * the second invalid before a rigid plane. */
      std::array<Index, 2> sides;
      /** Opening = sign × this unknown; invalid: the node is held by supports,
       * shared by both lips, or hangs between others. */
      Index  unknown = dealii::numbers::invalid_dof_index;
      double sign    = 1.;
      /** Contact force under a uniform pressure 1: the part of ∫φ n along the
       * normal, with the share of hanging nodes; at a kink it is less than ∫φ.
       * 0 if the node has no unknown, or if this is too little for its force to
       * tell a pressure, as for quadratic φ on an axis. */
      double weight = 0.;
      /** ∫φ over one lip, with the shares of the nodes that take their pressure
       * from this one. */
      double area = 0.;
      /** The nodes whose pressures a node without weight takes, by their
       * numbers, with factors. */
      std::vector<std::pair<unsigned int, double>> masters;

      bool
      has_unknown() const
      {
        return unknown != dealii::numbers::invalid_dof_index;
      }

      /** The component whose direction is nearest to the normal, the first of
       * equals: rounding must not decide, nor the mesh. */
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
     * @param supports the constraints of supports and hanging nodes, closed.
     * @throw SceneError if a face of a crack has no partner, or an opening is
     * not independent of others.
     */
    LipBasis(const Space<dim>                        &space,
             const dealii::AffineConstraints<double> &supports);

    std::vector<Node> nodes;

  private:
    struct Surroundings;

    Surroundings
    collect_nodes(const std::vector<LipFace<dim>> &faces);

    /** The number of the node on these sides, new or not. @param inward of the
     * face, whose sign it changes if the sides come the other way. */
    unsigned int
    node_number(const typename LipFace<dim>::Node &node,
                const Index                        other_side,
                dealii::Tensor<1, dim>            &inward,
                Surroundings                      &surroundings);

    /** The supports at the nodes, on all ranks. */
    Meanings
    gather_supports(const Space<dim>                        &space,
                    const dealii::AffineConstraints<double> &supports) const;

    /** Whether it hangs between other nodes; then these are its masters. */
    bool
    hangs(Node &node, const Surroundings &surroundings) const;

    void
    make_opening(Node &node, const Meanings &supported);

    /** Hanging nodes hand their loads on, which makes the weights. */
    void
    set_weights(Surroundings &surroundings);

    /** For nodes without weight. */
    void
    choose_masters(const Surroundings &surroundings);
  };
} // namespace Crevasse

#endif
