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
   * Substitution with one right-hand side in a supernodal factor that CHOLMOD
   * has made: columns with the same pattern are dense blocks, of a row for each
   * entry of the pattern. The many small ones of plane problems cost CHOLMOD a
   * sixth more, because it calls BLAS for each.
   *
   * Both take the unknowns in the factor's order, and stop at a column, so that
   * A = (A₁₁ A₁₂; A₂₁ A₂₂) is eliminated as far as there.
   */
  class SupernodalFactor
  {
  public:
    /** @param factor must outlive this object, and stay as it is. */
    explicit SupernodalFactor(const cholmod_factor_struct &factor);

    /** x₁ ← L₁₁⁻¹ x₁ for the columns before @p end, and x₂ ← x₂ − L₂₁ x₁. */
    void
    forward(double *x, const int end);

    /** x₁ ← L₁₁⁻ᵀ (x₁ − L₂₁ᵀ x₂). */
    void
    backward(double *x, const int end);

    /** The lower triangle from the column @p begin on. */
    dealii::FullMatrix<double>
    last_block(const int begin) const;

  private:
    /** What a supernode has before a column. */
    struct Block
    {
      int           first, n_columns, n_rows;
      const double *values; ///< column by column
      const int    *below;  ///< the rows after the triangle
      int           n_below;
    };

    Block
    block(const int supernode, const int end) const;

    const int     n_supernodes;
    const int    *columns, *row_starts, *value_starts, *rows;
    const double *values;

    std::vector<double> work; ///< of the rows of a block
  };
} // namespace Crevasse

#endif
