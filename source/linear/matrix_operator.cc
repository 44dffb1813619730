// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/linear/matrix_operator.h>
#include <crevasse/linear/matrix_product.h>

#include <algorithm>

namespace Crevasse
{
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



  std::vector<MatrixOperator::Indices>
  MatrixOperator::couplings(const Indices &rows, const Indices &columns) const
  {
    std::vector<Indices> coupled(rows.size());
    for (std::size_t k = 0; k < rows.size(); ++k)
      for (auto entry = sparse_matrix.begin(rows[k]);
           entry != sparse_matrix.end(rows[k]);
           ++entry)
        if (entry->column() != rows[k] && entry->value() != 0. &&
            std::binary_search(columns.begin(), columns.end(), entry->column()))
          coupled[k].push_back(entry->column());
    return coupled;
  }



  MPI_Comm
  MatrixOperator::get_mpi_communicator() const
  {
    return sparse_matrix.get_mpi_communicator();
  }



  const MatrixOperator::Matrix *
  MatrixOperator::matrix() const
  {
    return &sparse_matrix;
  }



  std::size_t
  MatrixOperator::memory_consumption() const
  {
    return matrix_diagonal.memory_consumption();
  }
} // namespace Crevasse
