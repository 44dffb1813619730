// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/contact/face_solver.h>
#include <crevasse/linear/conjugate_gradients.h>

namespace Crevasse
{
  using namespace dealii;

  FaceSolver::FaceSolver(const SignoriniProblem &problem,
                         LinearSolver           &linear_solver,
                         SolverStatistics       &counts)
    : problem(problem)
    , solver(linear_solver)
    , counts(counts)
    , projected_residual(problem.diagonal())
  {
  }



  void
  FaceSolver::project(const std::vector<bool> &held, Vector &vector) const
  {
    for (std::size_t k = 0; k < held.size(); ++k)
      if (held[k])
        vector(problem.bounds.dofs[k]) = 0.;
  }



  bool
  FaceSolver::solve(const std::vector<bool> &held,
                    const Vector            &residual,
                    const double             residual_norm,
                    Vector                  &correction)
  {
    projected_residual = residual;
    project(held, projected_residual);
    correction = 0.;

    std::vector<types::global_dof_index> held_dofs;
    for (std::size_t k = 0; k < held.size(); ++k)
      if (held[k])
        held_dofs.push_back(problem.bounds.dofs[k]);
    solver.hold(held_dofs);

    // Operators P A and P B, for vectors whose held entries are zero.
    const auto end = ConjugateGradients::iterate(
      [&](Vector &product, const Vector &v) {
        problem.stiffness.vmult(product, v);
        project(held, product);
      },
      [&](Vector &product, const Vector &v) {
        solver.precondition(product, v);
        project(held, product);
      },
      correction,
      projected_residual,
      residual_norm);
    ++counts.linear_solves;
    counts.linear_iterations += end.last_step();
    return end.last_check() == SolverControl::success;
  }
} // namespace Crevasse
