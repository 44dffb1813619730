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
  /** A symmetric positive definite A, of which most solvers need to know no
   * more than what it does to a vector: whether it is a matrix or a loop over
   * cells is its own affair. */
  class LinearOperator
  {
  public:
    using Matrix  = dealii::TrilinosWrappers::SparseMatrix;
    using Indices = std::vector<dealii::types::global_dof_index>;

    virtual ~LinearOperator() = default;

    /** result = A v. Collective. */
    virtual void
    vmult(Vector &result, const Vector &v) const = 0;

    /** The diagonal of A, or positive numbers of its size. */
    virtual const Vector &
    diagonal() const = 0;

    /** For each of the locally owned @p rows those of @p columns that A couples
     * with it, without itself: as a matrix those with an entry that is not 0,
     * otherwise those that share a cell with it. Collective.
     *
     * @param rows a subset of the columns.
     * @param columns ascending. */
    virtual std::vector<Indices>
    couplings(const Indices &rows, const Indices &columns) const = 0;

    virtual MPI_Comm
    get_mpi_communicator() const = 0;

    /** A as a matrix, or null: it is none. */
    virtual const Matrix *
    matrix() const = 0;

    /** Bytes on this rank, besides those of a matrix. */
    virtual std::size_t
    memory_consumption() const = 0;
  };
} // namespace Crevasse

#endif
