// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_supernodal_factor_h
#define crevasse_linear_supernodal_factor_h

#include <deal.II/lac/full_matrix.h>

#include <vector>

struct cholmod_factor_struct;

namespace Crevasse
{
  /**
   * Substitution with one right-hand side in a supernodal factor made by
   * CHOLMOD: columns with the same pattern are dense blocks, with a row for
   * each entry of the pattern. CHOLMOD calls BLAS for each of the many small
   * blocks of plane problems and needs a sixth more time.
   *
   * Forward and backward substitution use the factor's order, and stop at a
   * column: A = (A₁₁ A₁₂; A₂₁ A₂₂) is eliminated up to it.
   */
  class SupernodalFactor
  {
  public:
    /** @param factor Must outlive this object, unchanged. */
    explicit SupernodalFactor(const cholmod_factor_struct &factor);

    /** Forward substitution to @p end: x₁ ← L₁₁⁻¹ x₁, x₂ ← x₂ − L₂₁ x₁. */
    void
    forward(double *x, const int end);

    /** Backward substitution: x₁ ← L₁₁⁻ᵀ (x₁ − L₂₁ᵀ x₂). */
    void
    backward(double *x, const int end);

    /** Lower triangle of the factor from the column @p begin on. */
    dealii::FullMatrix<double>
    last_block(const int begin) const;

  private:
    /** Columns of a supernode before a given column. */
    struct Block
    {
      int           first, n_columns, n_rows;
      const double *values; ///< entries, column by column
      const int    *below;  ///< rows below the triangle
      int           n_below;
    };

    Block
    block(const int supernode, const int end) const;

    const int     n_supernodes;
    const int    *columns, *row_starts, *value_starts, *rows;
    const double *values;

    std::vector<double> work; ///< rows of a block
  };
} // namespace Crevasse

#endif
