// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/linear/matrix_operator.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_MultiVector.h>

namespace Crevasse
{
  using namespace dealii;

  MatrixOperator::MatrixOperator(const Matrix &matrix)
    : sparse_matrix(matrix)
    , matrix_diagonal(matrix.locally_owned_range_indices(),
                      matrix.get_mpi_communicator())
  {
    for (const auto i : matrix_diagonal.locally_owned_elements())
      matrix_diagonal(i) = matrix.diag_element(i);
  }



  void
  MatrixOperator::vmult(Vector &result, const Vector &v) const
  {
    multiply(sparse_matrix, result, v);
  }



  void
  multiply(const LinearOperator::Matrix &matrix,
           Vector                       &result,
           const Vector                 &v)
  {
    const Epetra_CrsMatrix &A      = matrix.trilinos_matrix();
    const int               n_rows = result.locally_owned_size(),
              n_columns            = v.locally_owned_size();
    AssertDimension(n_rows, A.RangeMap().NumMyElements());
    AssertDimension(n_columns, A.DomainMap().NumMyElements());
    // Views of both vectors without a copy; Epetra has no constant views.
    const Epetra_MultiVector seen_v(
      View, A.DomainMap(), const_cast<double *>(v.begin()), n_columns, 1);
    Epetra_MultiVector seen_result(
      View, A.RangeMap(), result.begin(), n_rows, 1);
    const int error = A.Multiply(false, seen_v, seen_result);
    AssertThrow(error == 0,
                TrilinosWrappers::SparseMatrix::ExcTrilinosError(error));
  }



  MatrixRows::MatrixRows(const LinearOperator::Matrix &matrix)
    : n(matrix.local_size())
  {
    const int error =
      matrix.trilinos_matrix().ExtractCrsDataPointers(starts, columns, values);
    AssertThrow(error == 0, ExcTrilinosError(error));
  }
} // namespace Crevasse
