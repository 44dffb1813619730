// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_harmonic_balance_lip_part_h
#define crevasse_harmonic_balance_lip_part_h

#include <crevasse/contact/signorini_problem.h>
#include <crevasse/linear/direct_solver.h>

#include <deal.II/lac/full_matrix.h>

namespace Crevasse
{
  /** A set of nodes of the lip: every rank knows the nodes of all ranks, in the
   * same order. L denotes the restriction to these nodes. */
  class LipPart
  {
  public:
    /** Collects the nodes of all ranks. Collective.
     *
     * @param chosen for each locally owned bound, whether it is in the set. */
    LipPart(const MPI_Comm           communicator,
            const UnilateralBounds  &bounds,
            const std::vector<bool> &chosen);

    unsigned int
    n_nodes() const
    {
      return nodes.dofs.size();
    }

    /** Normal components L v at the nodes, on all ranks. Collective. */
    dealii::Vector<double>
    restrict_to_lip(const Vector &v) const;

    /** Values at the nodes from a value for each local bound. Collective. */
    dealii::Vector<double>
    gather(const std::vector<double> &on_bounds) const;

    /** Values for local bounds, the inverse of gather(); 0 for other bounds. */
    std::vector<double>
    scatter(const dealii::Vector<double> &on_lip) const;

    /** Adds factor × Lᵀ g, the nodal forces of contact forces g, to v. */
    void
    add_forces(const double                  factor,
               const dealii::Vector<double> &forces,
               Vector                       &v) const;

    /** Computes the compliance L A⁻¹ Lᵀ. Collective.
     *
     * @param model a vector with the layout of A. */
    dealii::FullMatrix<double>
    compliance(LinearSolver &linear_solver, const Vector &model) const;

    UnilateralBounds nodes; ///< nodes of all ranks

  private:
    /** Compliance from the Schur complement of the factor, if it has one. */
    dealii::FullMatrix<double>
    from_factor(const DirectSolver &factor) const;

    /** Compliance by a linear solve for each node. */
    dealii::FullMatrix<double>
    from_columns(LinearSolver &linear_solver, const Vector &model) const;

    const MPI_Comm            communicator;
    const std::size_t         n_bounds; ///< locally owned bounds
    unsigned int              first = 0;
    std::vector<unsigned int> bounds; ///< indices of local nodes
  };
} // namespace Crevasse

#endif
