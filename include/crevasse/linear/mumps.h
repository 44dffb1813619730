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

#ifndef crevasse_linear_mumps_h
#define crevasse_linear_mumps_h

#include <crevasse/linear/linear_solver.h>

#include <memory>

namespace Crevasse
{
  /** Sparse factorisation by MUMPS through Trilinos' Amesos, on any number of
   * ranks. Amesos has MUMPS compute LU factors: unlike Cholesky's they exist
   * for an indefinite matrix too. */
  class Mumps : public LinearSolver
  {
  public:
    /** Factorises. @throw NumericalError if MUMPS fails. */
    explicit Mumps(const Matrix &matrix);
    ~Mumps() override;

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
    struct Factor; // keeps Amesos out of every includer
    std::unique_ptr<Factor> factor;
  };
} // namespace Crevasse

#endif
