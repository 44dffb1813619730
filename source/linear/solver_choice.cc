// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/linear/solver_choice.h>

#include <map>

namespace Crevasse
{
  std::string
  LinearSolverChoice::describe() const
  {
    static const std::map<Type, std::string> names = {{cholesky, "cholesky"},
                                                      {mumps, "mumps"},
                                                      {amg, "amg"},
                                                      {gmg, "gmg"}};
    return names.at(type) + " (" + why + ')';
  }



  std::string
  ContactSolverChoice::describe() const
  {
    return name + " (" + why + ')';
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
    using Choice            = LinearSolverChoice;
    const std::string limit = std::to_string(largest_factorised(dimension)) +
                              " unknowns in " + std::to_string(dimension) + "D";
    if (n_unknowns > largest_factorised(dimension))
      return {Choice::amg, "automatic: more than " + limit};
    if (n_ranks == 1)
      return {Choice::cholesky, "automatic: one process, at most " + limit};
    return {Choice::mumps, "automatic: several processes, at most " + limit};
  }



  LinearSolverChoice
  choose_linear_solver(const LinearSolverParameters &parameters,
                       const unsigned int            dimension,
                       const unsigned int            degree,
                       const std::size_t             n_unknowns,
                       const unsigned int            n_ranks,
                       const bool                    has_coarser_meshes)
  {
    using Choice          = LinearSolverChoice;
    const std::string why = "[Linear solver] Type = " + parameters.type;
    if (parameters.type == "cholesky")
      return {Choice::cholesky, why};
    if (parameters.type == "mumps")
      return {Choice::mumps, why};
    if (parameters.type == "amg")
      return {Choice::amg, why};
    if (parameters.type == "gmg")
      return {Choice::gmg, why};
    const LinearSolverChoice choice =
      choose_matrix_solver(dimension, n_unknowns, n_ranks);
    if (choice.type == Choice::amg && dimension == 3 && degree == 2 &&
        has_coarser_meshes)
      return {Choice::gmg,
              choice.why + ", of degree 2, on a mesh that has coarser ones"};
    return choice;
  }



  ContactSolverChoice
  choose_contact_solver(const ContactParameters  &parameters,
                        const LinearSolverChoice &linear_solver,
                        const std::size_t         n_bounds)
  {
    if (parameters.solver != "automatic")
      return {parameters.solver, "[Contact] Solver = " + parameters.solver};

    // The dense matrices of the condensed problem grow with the square of the
    // lip, the work on them with its cube.
    constexpr std::size_t largest_lip = 3000;
    if (linear_solver.is_multigrid())
      return {"active set",
              "automatic: without a factor there are no cheap "
              "columns of the compliance"};
    if (n_bounds > largest_lip)
      return {"active set",
              "automatic: the lip has more than " +
                std::to_string(largest_lip) + " nodes"};
    return {"condensed active set",
            "automatic: a factor, and a lip of at most " +
              std::to_string(largest_lip) + " nodes"};
  }
} // namespace Crevasse
