// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/contact/unconstrained.h>

#include <deal.II/base/exceptions.h>

namespace Crevasse
{
  Unconstrained::Unconstrained(const SignoriniProblem &problem,
                               LinearSolver           &linear_solver,
                               const double            tolerance)
    : ContactSolver(problem, tolerance)
    , linear_solver(linear_solver)
  {
    Assert(problem.n_bounds() == 0, dealii::ExcInternalError());
  }



  std::string
  Unconstrained::description() const
  {
    return "no contact; " + linear_solver.description();
  }



  std::size_t
  Unconstrained::iterate(const Vector &right_hand_side, Vector &solution)
  {
    solve_linear(linear_solver, right_hand_side, solution);
    if (asks_for_refinement())
      refine(linear_solver, right_hand_side, solution);
    return 1;
  }



  bool
  Unconstrained::can_refine() const
  {
    return linear_solver.is_direct();
  }
} // namespace Crevasse
