// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_harmonic_balance_lip_part_h
#define crevasse_harmonic_balance_lip_part_h

#include <crevasse/contact/signorini_problem.h>
#include <crevasse/linear/direct_solver.h>

#include <deal.II/lac/full_matrix.h>

namespace Crevasse
{
  /** Some nodes of the lip, of all ranks: every rank knows all of them, in the
   * same order. Where L is said, it is that of these nodes. */
  class LipPart
  {
  public:
    /** Collective.
     *
     * @param chosen which of the locally owned bounds belong to it. */
    LipPart(const MPI_Comm           communicator,
            const UnilateralBounds  &bounds,
            const std::vector<bool> &chosen);

    unsigned int
    n_nodes() const
    {
      return nodes.dofs.size();
    }

    /** L v, on all ranks. Collective. */
    dealii::Vector<double>
    restrict_to_lip(const Vector &v) const;

    /** The same of a value for each locally owned bound. */
    dealii::Vector<double>
    gather(const std::vector<double> &on_bounds) const;

    /** The inverse of gather(); 0 for other bounds. */
    std::vector<double>
    scatter(const dealii::Vector<double> &on_lip) const;

    /** v += factor × Lᵀ g */
    void
    add_forces(const double                  factor,
               const dealii::Vector<double> &forces,
               Vector                       &v) const;

    /** L A⁻¹ Lᵀ. Collective.
     *
     * @param model a vector with the layout of A. */
    dealii::FullMatrix<double>
    compliance(LinearSolver &linear_solver, const Vector &model) const;

    UnilateralBounds nodes; ///< of all ranks

  private:
    /** From the Schur complement, if the factor has one. */
    dealii::FullMatrix<double>
    from_factor(const DirectSolver &factor) const;

    /** By a solve for each node. */
    dealii::FullMatrix<double>
    from_columns(LinearSolver &linear_solver, const Vector &model) const;

    const MPI_Comm            communicator;
    const std::size_t         n_bounds; ///< locally owned ones
    unsigned int              first = 0;
    std::vector<unsigned int> bounds; ///< of the locally owned nodes
  };
} // namespace Crevasse

#endif
