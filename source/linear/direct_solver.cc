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
    const dealii::Timer timer;
    double              on_lip = 0.;
    back_solve_with_lip(solution.begin(),
                        right_hand_side.begin(),
                        [&](LipVector &values) {
                          const dealii::Timer timer_of_lip;
                          lip_problem(values);
                          on_lip = timer_of_lip.wall_time();
                        });
    count(timer.wall_time() - on_lip);
    lip_time += on_lip;
  }

} // namespace Crevasse
