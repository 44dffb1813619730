// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_cg_iteration_h
#define crevasse_linear_cg_iteration_h

#include <crevasse/linear/linear_solver.h>

#include <functional>

namespace Crevasse
{
  /** How an iteration ended. */
  struct CgResult
  {
    bool         has_converged;
    unsigned int n_iterations;
    double       residual_norm; ///< l₂
  };

  /** What a symmetric positive definite operator does to a vector. */
  using CgOperator =
    std::function<void(LinearSolver::Vector &, const LinearSolver::Vector &)>;

  /**
   * Conjugate gradients, at most 1000 iterations. Collective.
   *
   * @param[in,out] solution where they start and end.
   * @param residual_norm the l₂ norm at which they end.
   */
  CgResult
  iterate_cg(const CgOperator           &A,
             const CgOperator           &preconditioner,
             LinearSolver::Vector       &solution,
             const LinearSolver::Vector &right_hand_side,
             const double                residual_norm);
} // namespace Crevasse

#endif
