// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/linear/direct_solver.h>

#include <algorithm>

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
    count(1, timer.wall_time() - on_lip);
    lip_time += on_lip;
  }



  unsigned int
  DirectSolver::apply_inverse_to_all(std::vector<Vector> &right_hand_sides,
                                     const double)
  {
    if (right_hand_sides.empty())
      return 0;
    const std::size_t   n = right_hand_sides.front().locally_owned_size();
    std::vector<double> block(n * right_hand_sides.size());
    for (std::size_t k = 0; k < right_hand_sides.size(); ++k)
      std::copy(right_hand_sides[k].begin(),
                right_hand_sides[k].end(),
                block.begin() + k * n);
    std::vector<double> solutions(block.size());
    back_solve(solutions.data(), block.data(), right_hand_sides.size());
    for (std::size_t k = 0; k < right_hand_sides.size(); ++k)
      std::copy(solutions.begin() + k * n,
                solutions.begin() + (k + 1) * n,
                right_hand_sides[k].begin());
    return 0;
  }
} // namespace Crevasse
