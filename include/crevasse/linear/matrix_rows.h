// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_matrix_rows_h
#define crevasse_linear_matrix_rows_h

#include <deal.II/lac/trilinos_sparse_matrix.h>

namespace Crevasse
{
  /** A view of the rows of a matrix that lives on one rank, no copy, and of
   * none on the others: the entries of row i are those with numbers from
   * starts[i] up to, but without, starts[i + 1]. */
  struct MatrixRows
  {
    explicit MatrixRows(const dealii::TrilinosWrappers::SparseMatrix &matrix);

    int           n;
    const int    *starts;
    const int    *columns;
    const double *values;
  };
} // namespace Crevasse

#endif
