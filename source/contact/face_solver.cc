// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#include <crevasse/contact/face_solver.h>

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_control.h>

#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** P A, for vectors whose held entries are zero. */
    struct ProjectedMatrix
    {
      void
      vmult(Vector &result, const Vector &v) const
      {
        stiffness.vmult(result, v);
        face.project(held, result);
      }

      const LinearOperator    &stiffness;
      const FaceSolver        &face;
      const std::vector<bool> &held;
    };



    /** P B, where B is the linear solver's approximation of A⁻¹. */
    struct ProjectedPreconditioner
    {
      void
      vmult(Vector &result, const Vector &v) const
      {
        solver.precondition(result, v);
        face.project(held, result);
      }

      LinearSolver            &solver;
      const FaceSolver        &face;
      const std::vector<bool> &held;
    };
  } // namespace



  FaceSolver::FaceSolver(const SignoriniProblem &problem,
                         LinearSolver           &linear_solver)
    : problem(problem)
    , solver(linear_solver)
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

    constexpr unsigned int maximum_iterations = 1000;
    SolverControl          control(maximum_iterations, residual_norm);
    SolverCG<Vector>       cg(control);
    try
      {
        cg.solve(ProjectedMatrix{problem.stiffness, *this, held},
                 correction,
                 projected_residual,
                 ProjectedPreconditioner{solver, *this, held});
      }
    catch (const SolverControl::NoConvergence &)
      {
        // What was reached is judged by the caller.
      }
    ++solves;
    iterations += control.last_step();
    return control.last_check() == SolverControl::success;
  }



  std::size_t
  FaceSolver::n_solves() const
  {
    return solves;
  }



  std::size_t
  FaceSolver::n_iterations() const
  {
    return iterations;
  }



  const LinearSolver &
  FaceSolver::linear_solver() const
  {
    return solver;
  }
} // namespace Crevasse
