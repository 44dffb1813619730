// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_solver_choice_h
#define crevasse_linear_solver_choice_h

#include <crevasse/discretisation/space.h>
#include <crevasse/linear/cholesky.h>
#include <crevasse/parameters/parameters.h>

namespace Crevasse
{
  /** A selected solver and the reason. */
  template <typename Type>
  struct SolverChoiceOf
  {
    Type        type;
    std::string why;

    /** The choice as text, "cholesky (why)". */
    std::string
    describe() const
    {
      return name_of(type) + " (" + why + ')';
    }
  };

  using LinearSolverChoice  = SolverChoiceOf<LinearSolverType>;
  using ContactSolverChoice = SolverChoiceOf<ContactSolverType>;

  /** Largest number of unknowns for a factorisation: above it, its memory or
   * time exceed what the solves of a run are worth. */
  std::size_t
  largest_factorised(const unsigned int dimension);

  /** Fastest solver for a matrix of this size, by the measurements in
   * doc/contact_solvers.md: a factorisation, or CG + ML. */
  LinearSolverChoice
  choose_matrix_solver(const unsigned int dimension,
                       const std::size_t  n_unknowns,
                       const unsigned int n_ranks);

  /** Makes a linear solver for a matrix.
   *
   * @param lip Lip of a DirectSolver.
   * @param analysis Cholesky analysis of a matrix with the same pattern and
   * lip; if null, set to the analysis of this matrix. */
  template <int dim>
  std::unique_ptr<LinearSolver>
  make_matrix_solver(const LinearSolverType                   type,
                     const Space<dim>                        &space,
                     const LinearSolver::Matrix              &matrix,
                     const DirectSolver::Indices             &lip,
                     std::shared_ptr<const Cholesky::Factor> &analysis);

  /** The scene's solver; for "automatic" the fastest, by the measurements in
   * doc/contact_solvers.md and doc/scaling.md.
   *
   * @param has_coarser_meshes Whether gmg can be used (no matrix needed). */
  LinearSolverChoice
  choose_linear_solver(const LinearSolverParameters &parameters,
                       const unsigned int            dimension,
                       const std::size_t             n_unknowns,
                       const unsigned int            n_ranks,
                       const bool                    has_coarser_meshes);
} // namespace Crevasse

#endif
