// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_mumps_h
#define crevasse_linear_mumps_h

#include <crevasse/linear/direct_solver.h>

#include <memory>

namespace Crevasse
{
  /** Sparse factorisation LDLᵀ by MUMPS, on any number of ranks. Not through
   * Trilinos' Amesos, which has MUMPS compute LU, of twice the size, and solve
   * for many right-hand sides one by one. */
  class Mumps : public DirectSolver
  {
  public:
    /** Factorises. @throw NumericalError if MUMPS fails, or the matrix is not
     * positive definite. */
    explicit Mumps(const Matrix &matrix);
    ~Mumps() override;

    std::size_t
    memory_consumption() const override;

    std::string
    description() const override;

  protected:
    void
    back_solve(double            *solutions,
               const double      *right_hand_sides,
               const unsigned int n_columns) override;

  private:
    struct Factor; // keeps MUMPS out of every includer
    std::unique_ptr<Factor> factor;
  };
} // namespace Crevasse

#endif
