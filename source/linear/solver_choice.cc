// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/linear/solver_choice.h>

namespace Crevasse
{
  std::string
  LinearSolverChoice::describe() const
  {
    return name_of(type) + " (" + why + ')';
  }



  std::string
  ContactSolverChoice::describe() const
  {
    return name_of(type) + " (" + why + ')';
  }



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



  LinearSolverChoice
  choose_linear_solver(const LinearSolverParameters &parameters,
                       const unsigned int            dimension,
                       const unsigned int            degree,
                       const std::size_t             n_unknowns,
                       const unsigned int            n_ranks,
                       const bool                    has_coarser_meshes)
  {
    if (parameters.type != LinearSolverType::automatic)
      return {parameters.type,
              "[Linear solver] Type = " + name_of(parameters.type)};
    const LinearSolverChoice choice =
      choose_matrix_solver(dimension, n_unknowns, n_ranks);
    if (choice.type == LinearSolverType::amg && dimension == 3 && degree == 2 &&
        has_coarser_meshes)
      return {LinearSolverType::gmg,
              choice.why + ", of degree 2, on a mesh that has coarser ones"};
    return choice;
  }



  ContactSolverChoice
  choose_contact_solver(const ContactParameters  &parameters,
                        const LinearSolverChoice &linear_solver,
                        const std::size_t         n_bounds)
  {
    if (parameters.solver != ContactSolverType::automatic)
      return {parameters.solver,
              "[Contact] Solver = " + name_of(parameters.solver)};

    // The dense matrices of the condensed problem grow with the square of the
    // lip, the work on them with its cube.
    constexpr std::size_t largest_lip = 3000;
    if (linear_solver.is_multigrid())
      return {ContactSolverType::active_set,
              "automatic: without a factor there are no cheap "
              "columns of the compliance"};
    if (n_bounds > largest_lip)
      return {ContactSolverType::active_set,
              "automatic: the lip has more than " +
                std::to_string(largest_lip) + " nodes"};
    return {ContactSolverType::condensed_active_set,
            "automatic: a factor, and a lip of at most " +
              std::to_string(largest_lip) + " nodes"};
  }
} // namespace Crevasse
