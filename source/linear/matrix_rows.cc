// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/linear/matrix_rows.h>



#include <Epetra_CrsMatrix.h>

namespace Crevasse
{
  using namespace dealii;

  MatrixRows::MatrixRows(const TrilinosWrappers::SparseMatrix &matrix)
    : n(matrix.local_size())
  {
    Assert(n == 0 || matrix.local_size() == matrix.m(),
           ExcMessage("Rows of other ranks are not in sight."));
    int      *row_starts;
    int      *indices;
    double   *entries;
    const int error =
      matrix.trilinos_matrix().ExtractCrsDataPointers(row_starts,
                                                      indices,
                                                      entries);
    AssertThrow(error == 0, ExcTrilinosError(error));
    starts  = row_starts;
    columns = indices;
    values  = entries;
  }
} // namespace Crevasse
