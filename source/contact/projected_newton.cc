// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/contact/projected_newton.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  using namespace dealii;

  ProjectedNewton::ProjectedNewton(const SignoriniProblem &problem,
                                   FaceSolver             &face)
    : problem(problem)
    , face(face)
    , held(problem.bounds.dofs.size())
  {
  }



  void
  ProjectedNewton::project(Vector &solution) const
  {
    const UnilateralBounds &bounds = problem.bounds;
    for (std::size_t k = 0; k < bounds.dofs.size(); ++k)
      {
        double &q = solution(bounds.dofs[k]);
        if (bounds.sign[k] * q < bounds.gap[k])
          q = bounds.sign[k] * bounds.gap[k];
      }
  }



  void
  ProjectedNewton::find_face(const Vector &solution)
  {
    // Length of a projected Jacobi step: without the bounds within this reach,
    // short steps could zigzag between bounds.
    const UnilateralBounds &bounds = problem.bounds;
    double                  reach  = 0.;
    for (std::size_t k = 0; k < held.size(); ++k)
      {
        const auto   i       = bounds.dofs[k];
        const double opening = bounds.sign[k] * solution(i) - bounds.gap[k];
        const double step =
          bounds.sign[k] * residual(i) / problem.diagonal()(i);
        reach = std::max(reach, std::min(std::abs(step), std::abs(opening)));
      }
    reach =
      Utilities::MPI::max(reach, problem.stiffness.get_mpi_communicator());

    for (std::size_t k = 0; k < held.size(); ++k)
      {
        const auto   i       = bounds.dofs[k];
        const double opening = bounds.sign[k] * solution(i) - bounds.gap[k];
        held[k] = opening <= reach && bounds.sign[k] * residual(i) < 0.;
      }
  }



  bool
  ProjectedNewton::search_along_correction(Vector &solution)
  {
    // With the movement v, the energy changes by ½vᵀAv − rᵀv. Armijo's rule
    // compares this with the first-order decrease.
    constexpr double sufficient = 1e-4, shortest = 1e-12;
    for (double step = 1.; step > shortest; step *= 0.5)
      {
        trial = solution;
        trial.add(step, correction);
        project(trial);
        trial -= solution;
        if (trial.linfty_norm() == 0.)
          return false;
        problem.stiffness.vmult(product, trial);
        const double change = 0.5 * (trial * product) - residual * trial;
        // First-order decrease: of free unknowns along the direction, of held
        // unknowns along their bent movement (Bertsekas, (32)).
        double of_held = 0.;
        for (std::size_t k = 0; k < held.size(); ++k)
          if (const auto i = problem.bounds.dofs[k]; held[k])
            of_held += residual(i) * (trial(i) - step * correction(i));
        const double promise =
          step * (residual * correction) +
          Utilities::MPI::sum(of_held,
                              problem.stiffness.get_mpi_communicator());
        if (change <= -sufficient * promise)
          {
            solution += trial;
            project(solution); // removes rounding in gaps
            return true;
          }
      }
    return false;
  }



  unsigned int
  ProjectedNewton::solve(const Vector &right_hand_side,
                         Vector       &solution,
                         const double  residual_norm,
                         const std::function<bool(const Vector &)> &is_solved,
                         const unsigned int maximum_steps)
  {
    for (Vector *vector : {&residual, &correction, &trial, &product})
      vector->reinit(solution, true);
    project(solution);
    for (unsigned int n = 0; n < maximum_steps; ++n)
      {
        if (is_solved(solution))
          return n;
        problem.stiffness.vmult(residual, solution);
        residual.sadd(-1., 1., right_hand_side);
        find_face(solution);
        face.solve(held, residual, residual_norm, correction);
        // Newton's direction excludes the held unknowns; the diagonal of A
        // moves them, so that unknowns near their bounds reach them.
        for (std::size_t k = 0; k < held.size(); ++k)
          if (const auto i = problem.bounds.dofs[k]; held[k])
            correction(i) = residual(i) / problem.diagonal()(i);
        if (!search_along_correction(solution))
          return n;
      }
    return maximum_steps;
  }
} // namespace Crevasse
