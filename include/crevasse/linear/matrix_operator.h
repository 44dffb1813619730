// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_matrix_operator_h
#define crevasse_linear_matrix_operator_h

#include <crevasse/linear/linear_operator.h>

namespace Crevasse
{
  /** LinearOperator of an assembled matrix. */
  class MatrixOperator : public LinearOperator
  {
  public:
    /** Makes an operator of a matrix, which must outlive it. */
    explicit MatrixOperator(const Matrix &matrix);

    void
    vmult(Vector &result, const Vector &v) const override;

    const Vector &
    diagonal() const override
    {
      return matrix_diagonal;
    }

    MPI_Comm
    get_mpi_communicator() const override
    {
      return sparse_matrix.get_mpi_communicator();
    }

    const Matrix *
    matrix() const override
    {
      return &sparse_matrix;
    }

    std::size_t
    memory_consumption() const override
    {
      return matrix_diagonal.memory_consumption();
    }

  private:
    const Matrix &sparse_matrix;
    Vector        matrix_diagonal;
  };

  /** result = A v, by Epetra. Collective. Replaces deal.II's vmult(), whose
   * symbol in a library compiled by GCC is not the one that Clang looks for.
   *
   * @param[out] result Vector with the layout of the rows.
   * @param v Vector with the layout of the columns; ghosts are not read. */
  void
  multiply(const LinearOperator::Matrix &matrix,
           Vector                       &result,
           const Vector                 &v);

  /** View of the rows of a matrix on a single rank: the entries of row i are
   * those from starts[i] up to, but without, starts[i + 1]. */
  struct MatrixRows
  {
    explicit MatrixRows(const LinearOperator::Matrix &matrix);

    int     n;
    int    *starts, *columns;
    double *values;
  };
} // namespace Crevasse

#endif
