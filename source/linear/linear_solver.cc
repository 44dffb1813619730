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
    const Stopwatch watch("linear solves");
    iterations += apply_inverse(solution, right_hand_side, residual_norm);
    ++solves;
  }
} // namespace Crevasse
