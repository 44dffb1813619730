// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_principal_factor_h
#define crevasse_linear_principal_factor_h

#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <vector>

namespace Crevasse
{
  class StateArchive;

  /**
   * Cholesky factor RᵀR of the rows and columns in a set of a symmetric
   * positive definite matrix. The set changes from solve to solve.
   *
   * An index that enters the set is appended. Removing an index costs the rows
   * of R after it, which are then appended in reverse order: where a front
   * moves back and forth over the indices, the next ones to leave are always
   * the last in the factor, and cost nothing.
   */
  class PrincipalFactor
  {
  public:
    /** @param matrix Matrix, which must outlive this object: it is large. */
    explicit PrincipalFactor(const dealii::LAPACKFullMatrix<double> &matrix)
      : matrix(matrix)
    {
    }

    /** Factorises the matrix on a set. @throw NumericalError if the matrix is
     * not positive definite. */
    void
    choose(const std::vector<bool> &set);

    /** Solves on the set J: x_J ← A_JJ⁻¹ x_J. Other entries become zero. */
    void
    solve(dealii::Vector<double> &x);

    /** Serialises the factor: computed again, its last digits may differ. */
    void
    serialize(StateArchive &archive);

    /** Bytes of the factor, without the matrix. */
    std::size_t
    memory_consumption() const
    {
      return (values.capacity() + on_set.capacity()) * sizeof(double);
    }

    const dealii::LAPACKFullMatrix<double> &matrix;

  private:
    /** Computes the columns of R after the first @p n_known. */
    void
    extend(const unsigned int n_known);

    std::vector<unsigned int> order; ///< indices of the set in the order of R
    std::vector<double>       values, on_set;
  };
} // namespace Crevasse

#endif
