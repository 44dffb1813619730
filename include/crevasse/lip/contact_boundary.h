// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_lip_contact_boundary_h
#define crevasse_lip_contact_boundary_h

#include <crevasse/base/expression.h>
#include <crevasse/lip/contact_forces.h>
#include <crevasse/lip/lip_basis.h>

#include <deal.II/base/index_set.h>

namespace Crevasse
{
  /** Contact node of the lips, on the rank that owns its unknown. */
  template <int dim>
  struct LipNode : LipBasis<dim>::Node
  {
    unsigned int number; ///< number of the node in LipBasis
    double       gap;    ///< least normal displacement

    /** Normal displacement u_N of a displacement, or its rate. */
    double
    normal_part(const Vector &displacement) const
    {
      return this->sign * displacement(this->unknown);
    }

    /** Integral of the pressure over the part of the lip with this node's
     * pressure, from its contact force g. */
    double
    force(const double g) const
    {
      return this->weight > 0. ? g / this->weight * this->area : g;
    }
  };

  /** State of a node of LipBasis at an instant; without an unknown, open and
   * without pressure. */
  struct PairState
  {
    double opening = 0.; ///< u_N − gap
    /** Pressure of the node or, without weight, of its first master. */
    double pressure = 0.;
    /** Whether the node with this pressure, or this node, is under pressure,
     * not only in contact: its opening is negligible against the largest
     * displacement of the body, its force not negligible against the loads. */
    bool is_closed = false;
  };

  /** State of the lips at an instant, over all ranks. */
  struct LipTotals
  {
    unsigned int closed_nodes     = 0;  ///< closed free nodes
    double       force            = 0.; ///< force ∫ pressure, with held nodes
    double       largest_pressure = 0.;
    double       largest_opening  = 0.; ///< largest u_N − gap
  };

  /**
   * Lips of the crack in the contact problem, L in the paper's notation: u_N is
   * the normal displacement of a lip relative to the other lip or to a rigid
   * plane. Nodes whose normal displacement is fixed by a support, interpolated
   * (as at hanging nodes in space) or shared by both lips are not contact
   * nodes. See LipBasis.
   *
   * A hanging node transfers its share of the lip to the nodes from which it is
   * interpolated, as constrained shape functions do. This keeps the cells
   * around it from penetrating with linear elements, and with quadratic
   * elements at the nodes of the coarser side.
   *
   * A fixed node, as the crack tip, has no contact force: the support or the
   * body bears it. The force at a node without weight, as on an axis, gives no
   * pressure. The node takes the pressure of the nearest node with weight on
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
     * @param basis Must outlive this object.
     * @param dof_handler Must outlive this object.
     * @param owned_unknowns Unknowns of displacements that this rank owns.
     * @param gap_formula Least u_N, at most 0 (an initial opening is negative).
     * @throw SceneError with the point if the gap is positive somewhere.
     */
    ContactBoundary(const LipBasis<dim>           &basis,
                    const dealii::DoFHandler<dim> &dof_handler,
                    const dealii::IndexSet        &owned_unknowns,
                    Expression                   &&gap_formula);

    /** Nodes of all ranks. */
    const LipBasis<dim> &basis;

    /** Contact nodes of this rank, in the order of their unknowns. */
    std::vector<LipNode<dim>> nodes;

    /** Whether a contact node of any rank has a gap other than 0. */
    bool has_gap = false;

    /** Largest contact force that is rounding relative to the loads. */
    double negligible_force = 0.;

    /** States of all nodes of LipBasis, on all ranks. Collective. */
    std::vector<PairState>
    states(const Vector        &displacement,
           const ContactForces &contact_forces) const;

    /** State of the lips. Collective. */
    LipTotals
    totals(const Vector        &displacement,
           const ContactForces &contact_forces) const;

    /** Force ∫ pressure on all ranks, with held nodes. Collective. */
    double
    force(const ContactForces &contact_forces) const;

    /** Rates β_N of all nodes of LipBasis that a flow opens for good; 0 for
     * other nodes. Collective. */
    std::vector<double>
    opening_rates(const Vector &velocity) const;

    MPI_Comm
    communicator() const
    {
      return dof_handler.get_communicator();
    }

    /** Least u_N at a point of the lip. @throw SceneError if it is not finite
     * or positive. */
    double
    gap_at(const dealii::Point<dim> &point) const;

    /** Pressure at all nodes of the lips, on both sides: values at dofs, with
     * ghost values, in the component of each node that is nearest to the lip's
     * normal; zero elsewhere. Lips that share a dof give their mean.
     * Collective. */
    Vector
    pressure(const ContactForces &contact_forces) const;

    /** Nodal opening u_N − gap, or the smaller one where two lips meet: values
     * at dofs as of pressure(). Collective.
     * @param nodal_values Space::nodal_values() of the displacement. */
    Vector
    opening(const Vector &nodal_values) const;

    /** Transpose of pressure(): factors of the contact forces in a sum of
     * pressures with these weights. Collective.
     * @param weights Values at dofs, with ghost values, not compressed. */
    std::vector<double>
    of_contact_forces(Vector &weights) const;

  private:
    /** Degree of freedom with a pressure, and the numbers and factors of the
     * nodes that determine it. */
    struct Place
    {
      dealii::types::global_dof_index              dof;
      std::vector<std::pair<unsigned int, double>> masters;
    };

    const dealii::DoFHandler<dim> &dof_handler;
    const Expression               gap;
    const double       rounding; ///< rounding of coordinates, where gaps end
    std::vector<Place> places;
  };
} // namespace Crevasse

#endif
