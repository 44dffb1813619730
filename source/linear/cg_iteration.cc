// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/linear/cg_iteration.h>

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_control.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    using Vector = LinearSolver::Vector;

    /** As deal.II wants it. */
    struct Product
    {
      void
      vmult(Vector &result, const Vector &v) const
      {
        f(result, v);
      }

      const CgOperator &f;
    };
  } // namespace



  CgResult
  iterate_cg(const CgOperator &A,
             const CgOperator &preconditioner,
             Vector           &solution,
             const Vector     &right_hand_side,
             const double      residual_norm)
  {
    constexpr unsigned int maximum_iterations = 1000;
    SolverControl          control(maximum_iterations, residual_norm);
    SolverCG<Vector>       cg(control);
    try
      {
        cg.solve(Product{A},
                 solution,
                 right_hand_side,
                 Product{preconditioner});
      }
    catch (const SolverControl::NoConvergence &)
      {
        // What was reached is judged by the caller.
      }
    return {control.last_check() == SolverControl::success,
            control.last_step(),
            control.last_value()};
  }
} // namespace Crevasse
