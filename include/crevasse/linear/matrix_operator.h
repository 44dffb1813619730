// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------
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
    diagonal() const override;

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
