// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_contact_boundary_h
#define crevasse_discretisation_contact_boundary_h

#include <crevasse/base/expression.h>
#include <crevasse/discretisation/space.h>


namespace Crevasse
{
  /** One node of the crack lip on this rank. */
  template <int dim>
  struct LipNode
  {
    dealii::types::global_dof_index dof       = 0; ///< normal displacement
    unsigned int                    component = 0;
    double                          sign      = 1.; ///< u_N = sign × u[dof]
    double                          gap       = 0.; ///< u_N ≥ gap
    double                          weight    = 0.; ///< ∫φ over the lip
    /** ∫φ of the held nodes that take their pressure from this one. */
    double             held_weight = 0.;
    dealii::Point<dim> point;

    /** u_N − gap */
    double
    opening(const Vector &displacement) const
    {
      return sign * displacement(dof) - gap;
    }

    /** The force on the part of the lip that this node speaks for, from its
     * contact force g: g and the share of the held nodes around. */
    double
    force(const double g) const
    {
      return g * (1. + held_weight / weight);
    }
  };

  /**
   * The normal degrees of freedom of the crack lip, L in the paper's notation.
   * The lip must be parallel to the coordinate axes, which lets u_N be a
   * degree of freedom. Nodes whose normal displacement is held by a support or
   * interpolated between others, as hanging nodes are in space, are not contact
   * nodes.
   *
   * A hanging node hands its share of the lip on to the nodes that it is
   * interpolated from, as the shape functions with constraints do. That keeps
   * the cells around it from penetrating with linear elements, and with
   * quadratic ones at the nodes of the coarser side.
   *
   * A held node, as the crack tip that belongs to the ligament's plane of
   * symmetry, has no contact force of its own: the support bears it. Its
   * neighbours show what the lip bears: a held node takes the pressure
   * of the nearest free node on a face that it belongs to (0 if there is
   * none). The error is of the order of the mesh size, and none if the
   * pressure is uniform; an open crack has no pressure at its tip.
   */
  template <int dim>
  class ContactBoundary
  {
  public:
    /**
     * Collective.
     *
     * @param gap_formula The least u_N, at most 0 (an initial opening is
     * negative).
     * @throw SceneError if a face of the lip is not parallel to an axis, two
     * faces with opposite normals share a node, or the gap is positive
     * somewhere, with the place.
     */
    ContactBoundary(const Space<dim> &space, Expression &&gap_formula);

    /** The free nodes, in the order of their dofs. */
    std::vector<LipNode<dim>> nodes;

    /** The least u_N at any point of the lip. @throw SceneError if it is not
     * finite or positive. */
    double
    gap_at(const dealii::Point<dim> &point) const;

    /**
     * Gives each held node the value of the free ones that speak for it.
     * Collective.
     *
     * @param values at the dofs of the lip, with the layout of
     * Space::ghosted_vector(); ghost values are set at the end.
     */
    void
    spread_to_held_nodes(Vector &values) const;

    /** The transpose of spread_to_held_nodes(): adds the values of the held
     * nodes to those of the free ones that speak for them. Collective. */
    void
    gather_from_held_nodes(Vector &values) const;

  private:
    /** A free node that speaks for one that is not free, with its factor:
     * either the interpolation of a hanging node, or for lack of a better
     * one. */
    struct MasterNode
    {
      dealii::types::global_dof_index dof;
      double                          factor;
      bool                            interpolates;
    };

    /** A node without contact force of its own, and the free ones that speak
     * for it, if there are any. */
    struct HeldNode
    {
      dealii::types::global_dof_index dof;
      std::vector<MasterNode>         masters;
      double                          weight; ///< ∫φ over the lip
    };

    void
    find_nodes(const Space<dim> &space);

    /** @param nearest free node on a face of this constrained one; invalid if
     * there is none. */
    static HeldNode
    held_node(const LipNode<dim>                      &node,
              const dealii::AffineConstraints<double> &constraints,
              const dealii::types::global_dof_index    nearest);

    void
    share_weights(const Space<dim> &space);

    const Expression gap;
    const double rounding; ///< of coordinates, seen where a gap closes at a tip
    std::vector<HeldNode> held_nodes;
  };
} // namespace Crevasse

#endif
