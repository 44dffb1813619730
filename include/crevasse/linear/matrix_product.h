// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_matrix_product_h
#define crevasse_linear_matrix_product_h

#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

namespace Crevasse
{
  /** result = A v, by Epetra. Collective. The same as deal.II's vmult(), whose
   * name in a library that GCC has compiled is not the one that Clang looks
   * for.
   *
   * @param[out] result with the layout of the rows.
   * @param v with that of the columns; ghosts are not read. */
  void
  multiply(const dealii::TrilinosWrappers::SparseMatrix             &matrix,
           dealii::LinearAlgebra::distributed::Vector<double>       &result,
           const dealii::LinearAlgebra::distributed::Vector<double> &v);

  /** y = (A' + iA'') x, in real and imaginary parts. Collective.
   *
   * @param[out] y_real @p y_imaginary with the layout of the rows. */
  void
  complex_product(
    const dealii::TrilinosWrappers::SparseMatrix             &real,
    const dealii::TrilinosWrappers::SparseMatrix             &imaginary,
    const dealii::LinearAlgebra::distributed::Vector<double> &x_real,
    const dealii::LinearAlgebra::distributed::Vector<double> &x_imaginary,
    dealii::LinearAlgebra::distributed::Vector<double>       &y_real,
    dealii::LinearAlgebra::distributed::Vector<double>       &y_imaginary);
} // namespace Crevasse

#endif
