// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------
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
    is_direct() const override;

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
