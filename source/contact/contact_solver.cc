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

#include <crevasse/contact/contact_solver.h>
#include <crevasse/scene/problems.h>

#include <sstream>

namespace Crevasse
{
  ContactSolver::ContactSolver(const SignoriniProblem &problem,
                               const double            tolerance)
    : problem(problem)
    , tolerance(tolerance)
    , residual(problem.diagonal())
  {
    timer.stop();
    timer.reset();
  }



  Certificate
  ContactSolver::certify(const Vector &right_hand_side, const Vector &solution)
  {
    return Crevasse::certify(
      problem, right_hand_side, solution, scales, residual, forces);
  }



  void
  ContactSolver::solve(const Vector        &right_hand_side,
                       Vector              &solution,
                       std::vector<double> &contact_forces)
  {
    timer.start();
    const std::size_t n_new     = iterate(right_hand_side, solution);
    const Certificate certified = certify(right_hand_side, solution);
    timer.stop();
    if (!(certified.worst() <= tolerance))
      {
        std::ostringstream message;
        message << "The contact problem was not solved to the tolerance "
                << tolerance << " by " << description() << " in " << n_new
                << " iterations. Reached: " << certified.describe()
                << ". Try a larger [Contact] Maximum iterations, another "
                   "Relaxation factor, or a Tolerance above rounding (1e-13).";
        throw NumericalError(message.str());
      }
    ++solves;
    iterations += n_new;
    maxima.merge(certified);
    contact_forces = forces;
  }



  const Certificate &
  ContactSolver::worst_certificate() const
  {
    return maxima;
  }



  std::size_t
  ContactSolver::n_solves() const
  {
    return solves;
  }



  std::size_t
  ContactSolver::n_iterations() const
  {
    return iterations;
  }



  double
  ContactSolver::seconds() const
  {
    return timer.wall_time();
  }
} // namespace Crevasse
