// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/linear/direct_solver.h>

#include <algorithm>

namespace Crevasse
{
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
