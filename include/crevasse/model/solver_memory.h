// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_model_solver_memory_h
#define crevasse_model_solver_memory_h

#include <crevasse/linear/solver_choice.h>

#include <string>

namespace Crevasse
{
  /** By which factor predictions of memory may be wrong. */
  constexpr double memory_uncertainty = 1.25;

  /** Of a sparse matrix: value and column. */
  constexpr double bytes_per_entry = sizeof(double) + sizeof(int);

  /** Of what solves with a matrix, on one rank: a factor, or multigrid's
   * coarser matrices and smoothers, as much as the matrix again. */
  template <int dim>
  double
  bytes_of_matrix_solver(const LinearSolverType type,
                         const double           unknowns,
                         const double           own_unknowns,
                         const unsigned int     degree,
                         const unsigned int     n_ranks);

  /** Of geometric multigrid on one rank: vectors, and indices and weights of
   * the loops over cells; measured. */
  double
  bytes_of_gmg_vectors(const double unknowns, const unsigned int degree);

  /** Of all ranks: what solves with one stiffness takes at least, whatever
   * the body is made of. */
  template <int dim>
  double
  least_bytes_of_solver(const LinearSolverType type,
                        const double           n_unknowns,
                        const unsigned int     degree,
                        const unsigned int     n_ranks);
} // namespace Crevasse

#endif
