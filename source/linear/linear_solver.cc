// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/linear/linear_solver.h>

namespace Crevasse
{
  void
  LinearSolver::solve(Vector       &solution,
                      const Vector &right_hand_side,
                      const double  residual_norm)
  {
    const dealii::Timer timer;
    iterations += apply_inverse(solution, right_hand_side, residual_norm);
    count(1, timer.wall_time());
  }



  void
  LinearSolver::solve(std::vector<Vector> &right_hand_sides,
                      const double         residual_norm)
  {
    const dealii::Timer timer;
    iterations += apply_inverse_to_all(right_hand_sides, residual_norm);
    count(right_hand_sides.size(), timer.wall_time());
  }



  unsigned int
  LinearSolver::apply_inverse_to_all(std::vector<Vector> &right_hand_sides,
                                     const double         residual_norm)
  {
    unsigned int n = 0;
    for (Vector &right_hand_side : right_hand_sides)
      {
        const Vector copy = right_hand_side;
        right_hand_side   = 0.;
        n += apply_inverse(right_hand_side, copy, residual_norm);
      }
    return n;
  }

} // namespace Crevasse
