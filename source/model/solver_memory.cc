// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/model/linear_choice.h>
#include <crevasse/model/solver_memory.h>

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  namespace
  {
    /** CHOLMOD's factor on one rank and what its making takes for a moment:
     * fitted to runs with 29 250 and 115 842 unknowns in two dimensions, 12 675
     * and 28 611 in three, where the laws are those of nested dissection. */
    template <int dim>
    double
    bytes_of_cholesky(const double n, const unsigned int degree)
    {
      if (dim == 2)
        return 127. * n * std::log2(std::max(n, 2.));
      return (degree == 1 ? 152. : 228.) * std::pow(n, 4. / 3.);
    }
  } // namespace



  template <int dim>
  double
  bytes_of_matrix_solver(const LinearSolverType type,
                         const double           unknowns,
                         const double           own_unknowns,
                         const unsigned int     degree,
                         const unsigned int     n_ranks)
  {
    if (type == LinearSolverType::amg)
      return bytes_per_entry * n_matrix_entries<dim>(own_unknowns, degree);
    const double cholesky = bytes_of_cholesky<dim>(unknowns, degree);
    if (type == LinearSolverType::cholesky)
      return cholesky;
    // Fitted to the same runs on two ranks.
    constexpr double relative_size = dim == 2 ? 1.3 : 2.1;
    return relative_size * cholesky / n_ranks;
  }



  double
  bytes_of_gmg_vectors(const double unknowns, const unsigned int degree)
  {
    return sizeof(double) * (degree == 1 ? 60. : 25.) * unknowns;
  }



  template <int dim>
  double
  least_bytes_of_solver(const LinearSolverType type,
                        const double           n_unknowns,
                        const unsigned int     degree,
                        const unsigned int     n_ranks)
  {
    if (type == LinearSolverType::gmg)
      return bytes_of_gmg_vectors(n_unknowns, degree);
    const double own = n_unknowns / n_ranks;
    return n_ranks * (bytes_per_entry * n_matrix_entries<dim>(own, degree) +
                      bytes_of_matrix_solver<dim>(
                        type, n_unknowns, own, degree, n_ranks));
  }



#define INSTANTIATE(dim)                                              \
  template double bytes_of_matrix_solver<dim>(const LinearSolverType, \
                                              const double,           \
                                              const double,           \
                                              const unsigned int,     \
                                              const unsigned int);    \
  template double least_bytes_of_solver<dim>(const LinearSolverType,  \
                                             const double,            \
                                             const unsigned int,      \
                                             const unsigned int)

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
