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

#ifndef crevasse_linear_cholesky_h
#define crevasse_linear_cholesky_h

#include <crevasse/linear/linear_solver.h>

#include <memory>

namespace Crevasse
{
  /** Sparse Cholesky factorisation by CHOLMOD (SuiteSparse), on one rank. */
  class Cholesky : public LinearSolver
  {
  public:
    /** Factorises. @throw NumericalError if the matrix is not positive
     * definite; SceneError on several ranks. */
    explicit Cholesky(const Matrix &matrix);
    ~Cholesky() override;

    void
    precondition(Vector &solution, const Vector &right_hand_side) override;

    bool
    is_direct() const override;

    std::string
    description() const override;

  protected:
    unsigned int
    apply_inverse(Vector       &solution,
                  const Vector &right_hand_side,
                  const double  residual_norm) override;

    unsigned int
    apply_inverse_to_all(std::vector<Vector> &right_hand_sides,
                         const double         residual_norm) override;

  private:
    struct Factor; // keeps cholmod.h out of every includer
    std::unique_ptr<Factor> factor;
  };
} // namespace Crevasse

#endif
