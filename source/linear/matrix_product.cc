// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/linear/matrix_product.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_MultiVector.h>

namespace Crevasse
{
  using namespace dealii;

  void
  multiply(const TrilinosWrappers::SparseMatrix             &matrix,
           LinearAlgebra::distributed::Vector<double>       &result,
           const LinearAlgebra::distributed::Vector<double> &v)
  {
    const Epetra_CrsMatrix &A      = matrix.trilinos_matrix();
    const int               n_rows = result.locally_owned_size(),
              n_columns            = v.locally_owned_size();
    AssertDimension(n_rows, A.RangeMap().NumMyElements());
    AssertDimension(n_columns, A.DomainMap().NumMyElements());
    // Both are looked at where they are; Epetra does not know constant entries.
    const Epetra_MultiVector seen_v(
      View, A.DomainMap(), const_cast<double *>(v.begin()), n_columns, 1);
    Epetra_MultiVector seen_result(
      View, A.RangeMap(), result.begin(), n_rows, 1);
    const int error = A.Multiply(false, seen_v, seen_result);
    AssertThrow(error == 0,
                TrilinosWrappers::SparseMatrix::ExcTrilinosError(error));
  }



  void
  complex_product(const TrilinosWrappers::SparseMatrix             &real,
                  const TrilinosWrappers::SparseMatrix             &imaginary,
                  const LinearAlgebra::distributed::Vector<double> &x_real,
                  const LinearAlgebra::distributed::Vector<double> &x_imaginary,
                  LinearAlgebra::distributed::Vector<double>       &y_real,
                  LinearAlgebra::distributed::Vector<double>       &y_imaginary)
  {
    LinearAlgebra::distributed::Vector<double> product(y_real);
    multiply(real, y_real, x_real);
    multiply(imaginary, product, x_imaginary);
    y_real -= product;
    multiply(real, y_imaginary, x_imaginary);
    multiply(imaginary, product, x_real);
    y_imaginary += product;
  }
} // namespace Crevasse
