// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_solver_choice_h
#define crevasse_linear_solver_choice_h

#include <crevasse/discretisation/space.h>
#include <crevasse/linear/cholesky.h>
#include <crevasse/parameters/parameters.h>

namespace Crevasse
{
  /** Which solver, and why. */
  template <typename Type>
  struct SolverChoiceOf
  {
    Type        type;
    std::string why;

    /** "cholesky (why)". */
    std::string
    describe() const
    {
      return name_of(type) + " (" + why + ')';
    }
  };

  using LinearSolverChoice  = SolverChoiceOf<LinearSolverType>;
  using ContactSolverChoice = SolverChoiceOf<ContactSolverType>;

  /** Above this many unknowns a factor takes more memory, or its making more
   * time, than the solves of a run are worth. */
  std::size_t
  largest_factorised(const unsigned int dimension);

  /** What is fastest for a matrix of this size, by the measurements in
   * doc/contact_solvers.md: a factorisation, or CG + ML. */
  LinearSolverChoice
  choose_matrix_solver(const unsigned int dimension,
                       const std::size_t  n_unknowns,
                       const unsigned int n_ranks);

  /** Makes a solver of that type for a matrix.
   *
   * @param lip for a DirectSolver.
   * @param analysis of a matrix with the same pattern and lip for Cholesky, or
   * null: then that of this one. */
  template <int dim>
  std::unique_ptr<LinearSolver>
  make_matrix_solver(const LinearSolverType                   type,
                     const Space<dim>                        &space,
                     const LinearSolver::Matrix              &matrix,
                     const DirectSolver::Indices             &lip,
                     std::shared_ptr<const Cholesky::Factor> &analysis);

  /** What the scene asks for or, if that is "automatic", what is fastest by
   * the measurements in doc/contact_solvers.md and doc/scaling.md.
   *
   * @param has_coarser_meshes and nothing needs a matrix: gmg can be had. */
  LinearSolverChoice
  choose_linear_solver(const LinearSolverParameters &parameters,
                       const unsigned int            dimension,
                       const std::size_t             n_unknowns,
                       const unsigned int            n_ranks,
                       const bool                    has_coarser_meshes);
} // namespace Crevasse

#endif
