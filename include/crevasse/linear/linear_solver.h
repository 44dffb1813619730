// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_linear_solver_h
#define crevasse_linear_linear_solver_h

#include <crevasse/base/meters.h>
#include <crevasse/base/vector.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <cstddef>
#include <string>
#include <vector>

namespace Crevasse
{
  /**
   * Solves A x = b many times with one symmetric positive definite A, which
   * the constructor of the derived class prepares.
   */
  class LinearSolver
  {
  public:
    using Matrix = dealii::TrilinosWrappers::SparseMatrix;

    virtual ~LinearSolver() = default;

    /**
     * Solves A x = b. Iterative solvers start from @p solution and end when |b
     * − Ax|₂ is at most @p residual_norm; direct solvers use neither.
     *
     * @throw NumericalError if this residual is not reached.
     */
    void
    solve(Vector       &solution,
          const Vector &right_hand_side,
          const double  residual_norm);

    /** Applies a symmetric positive definite approximation of A⁻¹, which is
     * exact for direct solvers. Not counted as a solve. */
    virtual void
    precondition(Vector &solution, const Vector &right_hand_side) = 0;

    /** Makes precondition() approximate A without the rows and columns of these
     * unknowns, if the method can do that at no cost. The right-hand side of
     * precondition() must vanish there. Collective.
     *
     * @param dofs Locally owned unknowns. */
    virtual void
    hold(
      [[maybe_unused]] const std::vector<dealii::types::global_dof_index> &dofs)
    {
    }

    /** Whether solve() is exact at the cost of a back-solve. */
    virtual bool
    is_direct() const = 0;

    std::size_t
    n_solves() const
    {
      return solves;
    }

    /** Number of iterations in all solves; 0 for direct solvers. */
    std::size_t
    n_iterations() const
    {
      return iterations;
    }

    /** Bytes of the factor or the multigrid hierarchy on this rank. */
    virtual std::size_t
    memory_consumption() const = 0;

    /** Name of the method for the log and the summary. */
    virtual std::string
    description() const = 0;

    /** Name of the preconditioner for the log and the summary. */
    virtual std::string
    preconditioner_description() const
    {
      return description();
    }

  protected:
    /** Solves A x = b; returns the number of iterations, 0 if direct. */
    virtual unsigned int
    apply_inverse(Vector       &solution,
                  const Vector &right_hand_side,
                  const double  residual_norm) = 0;

    std::size_t solves = 0;

  private:
    std::size_t iterations = 0;
  };
} // namespace Crevasse

#endif
