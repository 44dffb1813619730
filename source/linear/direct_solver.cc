// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/linear/direct_solver.h>

namespace Crevasse
{
  void
  DirectSolver::solve_with_lip(Vector           &solution,
                               const Vector     &right_hand_side,
                               const LipProblem &lip_problem)
  {
    const Stopwatch watch("linear solves");
    back_solve_with_lip(solution.begin(),
                        right_hand_side.begin(),
                        [&](LipVector &values) {
                          const Stopwatch on_lip("contact on the lip");
                          lip_problem(values);
                        });
    ++solves;
  }
} // namespace Crevasse
