// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_harmonic_balance_complex_mumps_h
#define crevasse_harmonic_balance_complex_mumps_h

#include <crevasse/base/vector.h>
#include <crevasse/linear/mumps_instance.h>

#include <deal.II/lac/full_matrix.h>

#include <memory>

namespace Crevasse
{
  /**
   * Sparse factorisation, by MUMPS on any number of ranks, of a complex
   * symmetric matrix A* = A' + iA'' whose two parts are positive
   * (semi)definite: then no pivot is small (Higham 1998), and MUMPS does not
   * pivot.
   *
   * The matrix is condensed onto a set P of unknowns, which are eliminated
   * last: their Schur complement is the inverse of the compliance on P. That
   * costs far less than a column of A*⁻¹ for each unknown of P.
   */
  class ComplexMumps : private MumpsInstance<std::complex<double>>
  {
  public:
    using Matrix = dealii::TrilinosWrappers::SparseMatrix;

    /** Order in which unknowns are eliminated: the costly part of analysing a
     * pattern. Only rank 0 knows it. */
    using Ordering = std::vector<int>;

    /**
     * Factorises the matrix. Collective.
     *
     * @param real A', and @p imaginary A'', with the same pattern.
     * @param condensed the unknowns of P, of all ranks.
     * @param same_pattern the ordering of a matrix with the same pattern and
     * the same P, or null.
     * @throw NumericalError if MUMPS fails, or if the factor is inaccurate.
     */
    ComplexMumps(const Matrix                                       &real,
                 const Matrix                                       &imaginary,
                 const std::vector<dealii::types::global_dof_index> &condensed,
                 std::shared_ptr<const Ordering> same_pattern);

    /** Solves A* x = b, where both parts of b are overwritten by those of x.
     * Collective. */
    void
    solve(Vector &real, Vector &imaginary);

    /** Ordering to reuse for matrices with the same pattern and the same P. */
    std::shared_ptr<const Ordering> ordering;

    /** The rows and columns of P in A*⁻¹, in the order of P; the same on all
     * ranks. */
    dealii::FullMatrix<std::complex<double>> compliance;

    using MumpsInstance<std::complex<double>>::memory_consumption;

  private:
    using Complex = std::complex<double>;

    /** Inverts the Schur complement to the compliance. */
    void
    invert();

    /** Checks the factor. @throw NumericalError if it does not solve the system
     * with the solution 1. */
    void
    check(const Matrix &real, const Matrix &imaginary);
  };
} // namespace Crevasse

#endif
