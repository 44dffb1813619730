// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_conjugate_gradients_h
#define crevasse_linear_conjugate_gradients_h

#include <crevasse/linear/linear_solver.h>

namespace Crevasse
{
  /** What all solvers by conjugate gradients have in common: they differ in A
   * and its preconditioner. */
  class ConjugateGradients : public LinearSolver
  {
  public:
    bool
    is_direct() const override
    {
      return false;
    }

    std::string
    description() const override;

  protected:
    /** result = A v */
    virtual void
    multiply(Vector &result, const Vector &v) const = 0;

    unsigned int
    apply_inverse(Vector       &solution,
                  const Vector &right_hand_side,
                  const double  residual_norm) override;
  };
} // namespace Crevasse

#endif
