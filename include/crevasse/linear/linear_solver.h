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
     * Iterative solvers start from @p solution and end when |b − Ax|₂ is at
     * most @p residual_norm, which depends on what the caller needs; direct
     * solvers use neither.
     *
     * @throw NumericalError if that residual is not reached.
     */
    void
    solve(Vector       &solution,
          const Vector &right_hand_side,
          const double  residual_norm);

    /** One application of a symmetric positive definite approximation of A⁻¹:
     * exact for direct solvers. It is not counted as a solve. */
    virtual void
    precondition(Vector &solution, const Vector &right_hand_side) = 0;

    /** Makes precondition() one for A without the rows and columns of these
     * unknowns, if the method can do that at no price. The right-hand side of
     * precondition() must vanish there. Collective.
     *
     * @param dofs locally owned ones. */
    virtual void
    hold(
      [[maybe_unused]] const std::vector<dealii::types::global_dof_index> &dofs)
    {
    }

    /** Whether solve() is exact, at the price of a back-solve. */
    virtual bool
    is_direct() const = 0;

    std::size_t
    n_solves() const
    {
      return solves;
    }

    /** Of the iterative solvers, over all solves. */
    std::size_t
    n_iterations() const
    {
      return iterations;
    }

    /** Bytes of the factor or the multigrid hierarchy, on this rank. */
    virtual std::size_t
    memory_consumption() const = 0;

    /** For the log and the summary. */
    virtual std::string
    description() const = 0;

    /** The same of precondition(). */
    virtual std::string
    preconditioner_description() const
    {
      return description();
    }

  protected:
    /** Returns the number of iterations, 0 for direct solvers. */
    virtual unsigned int
    apply_inverse(Vector       &solution,
                  const Vector &right_hand_side,
                  const double  residual_norm) = 0;

    std::size_t solves          = 0;
    double      bytes_per_solve = 0.; ///< of the factor, on this rank

  private:
    std::size_t iterations = 0;
  };
} // namespace Crevasse

#endif
