// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_contact_boundary_h
#define crevasse_discretisation_contact_boundary_h

#include <crevasse/base/expression.h>
#include <crevasse/discretisation/space.h>

namespace Crevasse
{
  /** One place of the lips that may open, on the rank that has its unknown. */
  template <int dim>
  struct LipNode
  {
    dealii::types::global_dof_index dof = 0; ///< opening: sign × u[dof] − gap
    double                          sign   = 1.; ///< of the normal displacement
    double                          gap    = 0.; ///< that is at least this
    double                          weight = 0.; ///< see LipBasis
    double area = 0.; ///< ∫φ, with the shares of nodes without weight
    /** The unknown of the node whose pressure it has: without weight another
     * one, or none. */
    dealii::types::global_dof_index source = dof;
    dealii::Point<dim>              point;
    unsigned int                    number = 0; ///< in LipBasis
    dealii::Tensor<1, dim> normal; ///< unit, into the first side's body

    /** u_N − gap */
    double
    opening(const Vector &displacement) const
    {
      return sign * displacement(dof) - gap;
    }

    /** ∫ pressure over the part of the lip whose pressure this node has, from
     * its contact force g. */
    double
    force(const double g) const
    {
      return weight > 0. ? g / weight * area : g;
    }
  };

  /** What a place of the lips does at an instant. */
  struct LipNodeState
  {
    double opening;  ///< u_N − gap
    double pressure; ///< of the node that has it for this one
    /** Whether this node or that one is pressed, not only touched: its opening
     * vanishes against the largest displacement of the body, and its force does
     * not against the loads. */
    bool is_closed;
  };

  /**
   * The crack's lips as the contact problem has them, L in the paper's
   * notation: u_N is the normal displacement of a lip against that of the other
   * lip or of a rigid plane. Nodes whose normal displacement is held by a
   * support, interpolated between others, as hanging nodes are in space, or
   * shared by both lips are not contact nodes. See LipBasis.
   *
   * A hanging node hands its share of the lip on to the nodes that it is
   * interpolated from, as the shape functions with constraints do. That keeps
   * the cells around it from penetrating with linear elements, and with
   * quadratic ones at the nodes of the coarser side.
   *
   * A held node, as the crack tip, has no contact force of its own: the support
   * or the body bears it. That of a node without weight, as on an axis, tells
   * no pressure. Their neighbours show what the lip bears: such a node takes
   * the pressure of the nearest node with weight on a face that it belongs to
   * (0 if there is none), and is closed with it. The error is of the order of
   * the mesh size, and none if the pressure is uniform; an open crack has no
   * pressure at its tip.
   */
  template <int dim>
  class ContactBoundary
  {
  public:
    /**
     * Collective.
     *
     * @param space must outlive this object.
     * @param gap_formula The least u_N, at most 0 (an initial opening is
     * negative).
     * @throw SceneError if the gap is positive somewhere, with the place.
     */
    ContactBoundary(const Space<dim> &space, Expression &&gap_formula);

    /** Of this rank, in the order of their unknowns. */
    std::vector<LipNode<dim>> nodes;

    /** Contact forces up to this one are rounding beside the loads. */
    double negligible_force = 0.;

    /** What the nodes of this rank do. Collective. */
    std::vector<LipNodeState>
    states(const Vector              &displacement,
           const std::vector<double> &contact_forces) const;

    /** The least u_N at any point of the lip. @throw SceneError if it is not
     * finite or positive. */
    double
    gap_at(const dealii::Point<dim> &point) const;

    /** The pressure at all nodes of the lips, on both sides: values at degrees
     * of freedom, with ghost values, zero but for the component of a node that
     * is nearest to the lip's normal. Where several lips have that in common,
     * the mean of theirs. Collective.
     * @param contact_forces of the nodes of this rank. */
    Vector
    pressure(const std::vector<double> &contact_forces) const;

    /** The transpose: by what each contact force is multiplied in a sum over
     * pressures with these weights. Collective.
     * @param weights with the layout of Space::ghosted_vector(), not
     * compressed. */
    std::vector<double>
    of_contact_forces(Vector &weights) const;

  private:
    /** A degree of freedom that holds a pressure, and the unknowns of the nodes
     * from which it has that. */
    struct Place
    {
      dealii::types::global_dof_index dof;
      typename LipBasis<dim>::Weights masters;
    };

    const Space<dim>  &space;
    const Expression   gap;
    const double       rounding; ///< of coordinates, where a gap ends at a tip
    std::vector<Place> places;
  };
} // namespace Crevasse

#endif
