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
   * The Cholesky factor RᵀR of those rows and columns of a symmetric positive
   * definite matrix that belong to a set, which changes from solve to solve.
   *
   * What enters the set is appended. What leaves it costs the rows of R that
   * come after it, which are then appended in the opposite order: where a front
   * runs back and forth over the numbers, the next ones to leave are always the
   * last in the factor, and cost nothing.
   */
  class PrincipalFactor
  {
  public:
    /** @param matrix must outlive this object: it is large. */
    explicit PrincipalFactor(const dealii::LAPACKFullMatrix<double> &matrix)
      : matrix(matrix)
    {
    }

    /** Makes it the factor of this set. @throw NumericalError if the matrix is
     * not positive definite. */
    void
    choose(const std::vector<bool> &set);

    /** x_J ← A_JJ⁻¹ x_J on the set J. The other entries become zero. */
    void
    solve(dealii::Vector<double> &x);

    /** Computed once more it might differ in the last digit. */
    void
    serialize(StateArchive &archive);

    /** Without the matrix. */
    std::size_t
    memory_consumption() const
    {
      return (values.capacity() + on_set.capacity()) * sizeof(double);
    }

    const dealii::LAPACKFullMatrix<double> &matrix;

  private:
    /** Completes R for all of the order but the first @p n_known. */
    void
    extend(const unsigned int n_known);

    std::vector<unsigned int> order; ///< of the set in R
    std::vector<double>       values, on_set;
  };
} // namespace Crevasse

#endif
