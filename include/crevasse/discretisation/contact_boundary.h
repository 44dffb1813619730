// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_contact_boundary_h
#define crevasse_discretisation_contact_boundary_h

#include <crevasse/base/expression.h>
#include <crevasse/discretisation/space.h>

namespace Crevasse
{
  /** A contact node of the lips, on the rank that has its unknown. */
  template <int dim>
  struct LipNode
  {
    dealii::types::global_dof_index dof = 0; ///< opening: sign × u[dof] − gap
    double sign   = 1.; ///< sign of the normal displacement
    double gap    = 0.; ///< least normal displacement
    double weight = 0.; ///< see LipBasis::Node
    double area   = 0.; ///< ∫φ, with the shares of nodes without weight
    /** Unknown of the node whose pressure this node takes: without weight
     * another node's, or invalid. */
    dealii::types::global_dof_index source = dof;
    dealii::Point<dim>              point;
    unsigned int                    number = 0; ///< number in LipBasis
    dealii::Tensor<1, dim> normal; ///< unit normal into the first side's body

    /** Opening u_N − gap. */
    double
    opening(const Vector &displacement) const
    {
      return sign * displacement(dof) - gap;
    }

    /** Integral of the pressure over the part of the lip with this node's
     * pressure, from its contact force g. */
    double
    force(const double g) const
    {
      return weight > 0. ? g / weight * area : g;
    }
  };

  /** State of a contact node at an instant. */
  struct LipNodeState
  {
    double opening;  ///< u_N − gap
    double pressure; ///< pressure of the source node
    /** Whether this node or its source is under pressure, not only in contact:
     * its opening is negligible against the largest displacement of the body,
     * its force not negligible against the loads. */
    bool is_closed;
  };

  /**
   * The crack's lips in the contact problem, L in the paper's notation: u_N is
   * the normal displacement of a lip relative to the other lip or to a rigid
   * plane. Nodes whose normal displacement is fixed by a support, interpolated
   * as at hanging nodes in space, or shared by both lips are no contact nodes.
   * See LipBasis.
   *
   * A hanging node transfers its share of the lip to the nodes from which it is
   * interpolated, as constrained shape functions do. This keeps the cells
   * around it from penetrating with linear elements, and with quadratic
   * elements at the nodes of the coarser side.
   *
   * A fixed node, as the crack tip, has no contact force: the support or the
   * body bears it. The force at a node without weight, as on an axis, gives no
   * pressure. Such a node takes the pressure of the nearest node with weight on
   * one of its faces (0 if there is none), and is closed with it. The error is
   * of the order of the mesh size, and zero if the pressure is uniform; an open
   * crack has no pressure at its tip.
   */
  template <int dim>
  class ContactBoundary
  {
  public:
    /**
     * Finds the contact nodes. Collective.
     *
     * @param space Must outlive this object.
     * @param gap_formula Least u_N, at most 0 (an initial opening is negative).
     * @throw SceneError with the point if the gap is positive somewhere.
     */
    ContactBoundary(const Space<dim> &space, Expression &&gap_formula);

    /** Contact nodes of this rank, in the order of their unknowns. */
    std::vector<LipNode<dim>> nodes;

    /** Largest contact force that is rounding relative to the loads. */
    double negligible_force = 0.;

    /** States of the contact nodes of this rank. Collective. */
    std::vector<LipNodeState>
    states(const Vector              &displacement,
           const std::vector<double> &contact_forces) const;

    /** Least u_N at a point of the lip. @throw SceneError if it is not finite
     * or positive. */
    double
    gap_at(const dealii::Point<dim> &point) const;

    /** Pressure at all nodes of the lips, on both sides: values at dofs, with
     * ghost values, in the component of each node that is nearest to the lip's
     * normal; zero elsewhere. Lips that share a dof give their mean.
     * Collective.
     * @param contact_forces Forces of the nodes of this rank. */
    Vector
    pressure(const std::vector<double> &contact_forces) const;

    /** Transpose of pressure(): factors of the contact forces in a sum of
     * pressures with these weights. Collective.
     * @param weights Vector with the layout of Space::ghosted_vector(), not
     * compressed. */
    std::vector<double>
    of_contact_forces(Vector &weights) const;

  private:
    /** A degree of freedom that holds a pressure, and the unknowns of the nodes
     * that determine it. */
    struct Place
    {
      dealii::types::global_dof_index dof;
      typename LipBasis<dim>::Weights masters;
    };

    const Space<dim>  &space;
    const Expression   gap;
    const double       rounding; ///< rounding of coordinates, where gaps end
    std::vector<Place> places;
  };
} // namespace Crevasse

#endif
