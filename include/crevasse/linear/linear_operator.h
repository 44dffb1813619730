// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_linear_operator_h
#define crevasse_linear_linear_operator_h

#include <crevasse/base/vector.h>

#include <deal.II/base/types.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <cstddef>
#include <vector>

namespace Crevasse
{
  /** A symmetric positive definite operator A. Most solvers need only its
   * products with vectors: it may be a matrix or a loop over cells. */
  class LinearOperator
  {
  public:
    using Matrix  = dealii::TrilinosWrappers::SparseMatrix;
    using Indices = std::vector<dealii::types::global_dof_index>;

    virtual ~LinearOperator() = default;

    /** Applies the operator: result = A v. Collective. */
    virtual void
    vmult(Vector &result, const Vector &v) const = 0;

    /** Diagonal of A, or positive numbers of similar size. */
    virtual const Vector &
    diagonal() const = 0;

    virtual MPI_Comm
    get_mpi_communicator() const = 0;

    /** A as a matrix, or null if A has no matrix. */
    virtual const Matrix *
    matrix() const = 0;

    /** Bytes of the operator on this rank, without the matrix. */
    virtual std::size_t
    memory_consumption() const = 0;
  };
} // namespace Crevasse

#endif
