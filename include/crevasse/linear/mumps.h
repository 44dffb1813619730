// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_mumps_h
#define crevasse_linear_mumps_h

#include <crevasse/linear/direct_solver.h>
#include <crevasse/linear/mumps_instance.h>

namespace Crevasse
{
  /** Sparse factorisation LDLᵀ by MUMPS, on any number of ranks. Trilinos'
   * Amesos is not used: it makes MUMPS compute LU, of twice the size, and
   * solve many right-hand sides one by one. */
  class Mumps : public DirectSolver
  {
  public:
    /** Factorises a matrix. @throw NumericalError if MUMPS fails, or the matrix
     * is not positive definite. */
    explicit Mumps(const Matrix &matrix, const Indices &lip = {});

    std::size_t
    memory_consumption() const override
    {
      return factor.memory_consumption() + lip_factor.memory_consumption() +
             schur_complement.memory_consumption();
    }

    std::string
    description() const override
    {
      return "MUMPS on " + std::to_string(factor.n_ranks) +
             (factor.n_ranks == 1 ? " rank" : " ranks");
    }

    void
    precondition(Vector &solution, const Vector &right_hand_side) override;

    void
    solve_with_lip(Vector           &solution,
                   const Vector     &right_hand_side,
                   const LipProblem &lip_problem) override;

  private:
    MumpsInstance<double>            factor;
    dealii::LAPACKFullMatrix<double> lip_factor; ///< factor of Σ
  };
} // namespace Crevasse

#endif
