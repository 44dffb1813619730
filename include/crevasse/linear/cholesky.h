// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_cholesky_h
#define crevasse_linear_cholesky_h

#include <crevasse/linear/direct_solver.h>

#include <memory>

namespace Crevasse
{
  /** Sparse Cholesky factorisation by CHOLMOD (SuiteSparse), on one rank. */
  class Cholesky : public DirectSolver
  {
  public:
    /** A factor with CHOLMOD's settings and workspace; keeps cholmod.h out of
     * other headers. */
    struct Factor;

    /** Factorises a matrix.
     *
     * @param lip See DirectSolver.
     * @param same_pattern Analysis of a matrix with the same pattern and lip,
     * or null. @throw NumericalError if the matrix is not positive definite;
     * SceneError on several ranks. */
    explicit Cholesky(const Matrix                 &matrix,
                      const Indices                &lip          = {},
                      std::shared_ptr<const Factor> same_pattern = nullptr);
    ~Cholesky() override;

    /** Checks the number of ranks. @throw SceneError if there are several. */
    static void
    require_one_process(const MPI_Comm communicator);

    /** Symbolic analysis (ordering and pattern), for other matrices with the
     * same pattern. */
    std::shared_ptr<const Factor>
    analysis() const
    {
      return pattern;
    }

    std::size_t
    memory_consumption() const override;

    std::string
    description() const override;

    void
    precondition(Vector &solution, const Vector &right_hand_side) override;

    void
    solve_with_lip(Vector           &solution,
                   const Vector     &right_hand_side,
                   const LipProblem &lip_problem) override;

  private:
    /** Computes Σ from the lip's part of the factor. */
    void
    condense();

    std::shared_ptr<const Factor> pattern;
    std::unique_ptr<Factor>       factor;
  };
} // namespace Crevasse

#endif
