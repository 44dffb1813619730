// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_matrix_operator_h
#define crevasse_linear_matrix_operator_h

#include <crevasse/linear/linear_operator.h>

namespace Crevasse
{
  /** An assembled A. */
  class MatrixOperator : public LinearOperator
  {
  public:
    /** The matrix must outlive this object. */
    explicit MatrixOperator(const Matrix &matrix);

    void
    vmult(Vector &result, const Vector &v) const override;

    const Vector &
    diagonal() const override
    {
      return matrix_diagonal;
    }

    std::vector<Indices>
    couplings(const Indices &rows, const Indices &columns) const override;

    MPI_Comm
    get_mpi_communicator() const override;

    const Matrix *
    matrix() const override;

    std::size_t
    memory_consumption() const override;

  private:
    const Matrix &sparse_matrix;
    Vector        matrix_diagonal;
  };
} // namespace Crevasse

#endif
