// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/rigid_modes.h>
#include <crevasse/linear/amg_cg.h>
#include <crevasse/linear/mumps.h>
#include <crevasse/linear/solver_choice.h>

namespace Crevasse
{
  std::size_t
  largest_factorised(const unsigned int dimension)
  {
    return dimension == 2 ? 4000000 : 150000;
  }



  LinearSolverChoice
  choose_matrix_solver(const unsigned int dimension,
                       const std::size_t  n_unknowns,
                       const unsigned int n_ranks)
  {
    using Type              = LinearSolverType;
    const std::string limit = std::to_string(largest_factorised(dimension)) +
                              " unknowns in " + std::to_string(dimension) + "D";
    if (n_unknowns > largest_factorised(dimension))
      return {Type::amg, "automatic: more than " + limit};
    if (n_ranks == 1)
      return {Type::cholesky, "automatic: one process, at most " + limit};
    return {Type::mumps, "automatic: several processes, at most " + limit};
  }



  template <int dim>
  std::unique_ptr<LinearSolver>
  make_matrix_solver(const LinearSolverType                   type,
                     const Space<dim>                        &space,
                     const LinearSolver::Matrix              &matrix,
                     const DirectSolver::Indices             &lip,
                     std::shared_ptr<const Cholesky::Factor> &analysis)
  {
    if (type == LinearSolverType::amg)
      return std::make_unique<AmgCg>(matrix,
                                     rigid_modes(space),
                                     // Unknowns of lips are not sorted by node.
                                     space.lip.n_unknowns == 0 ? dim : 1,
                                     space.finite_element.degree > 1);
    if (type == LinearSolverType::mumps)
      return std::make_unique<Mumps>(matrix, lip);
    auto cholesky = std::make_unique<Cholesky>(matrix, lip, analysis);
    analysis      = cholesky->analysis();
    return cholesky;
  }



  LinearSolverChoice
  choose_linear_solver(const LinearSolverParameters &parameters,
                       const unsigned int            dimension,
                       const std::size_t             n_unknowns,
                       const unsigned int            n_ranks,
                       const bool                    has_coarser_meshes)
  {
    if (parameters.type != LinearSolverType::automatic)
      return {parameters.type,
              "[Linear solver] Type = " + name_of(parameters.type)};
    const LinearSolverChoice choice =
      choose_matrix_solver(dimension, n_unknowns, n_ranks);
    if (choice.type == LinearSolverType::amg && has_coarser_meshes)
      return {LinearSolverType::gmg,
              choice.why + ", and the mesh has coarser levels"};
    return choice;
  }



  template decltype(make_matrix_solver<2>) make_matrix_solver<2>;
  template decltype(make_matrix_solver<3>) make_matrix_solver<3>;
} // namespace Crevasse
