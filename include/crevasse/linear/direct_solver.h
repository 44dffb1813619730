// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_direct_solver_h
#define crevasse_linear_direct_solver_h

#include <crevasse/linear/linear_solver.h>

namespace Crevasse
{
  /** What all solvers by a factorisation have in common: a solve is exact and
   * costs a back-solve, which derived classes do for a block of columns. */
  class DirectSolver : public LinearSolver
  {
  public:
    bool
    is_direct() const override
    {
      return true;
    }

    void
    precondition(Vector &solution, const Vector &right_hand_side) override
    {
      back_solve(solution.begin(), right_hand_side.begin(), 1);
    }

  protected:
    unsigned int
    apply_inverse(Vector       &solution,
                  const Vector &right_hand_side,
                  const double) override
    {
      precondition(solution, right_hand_side);
      return 0;
    }

    unsigned int
    apply_inverse_to_all(std::vector<Vector> &right_hand_sides,
                         const double         residual_norm) override;

    /** Both blocks lie column by column in memory, with the locally owned
     * entries of @p n_columns vectors. */
    virtual void
    back_solve(double            *solutions,
               const double      *right_hand_sides,
               const unsigned int n_columns) = 0;
  };
} // namespace Crevasse

#endif
