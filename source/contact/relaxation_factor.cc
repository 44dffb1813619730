// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/contact/relaxation_factor.h>
#include <crevasse/contact/sweep.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace Crevasse
{
  SorCount
  count_sor_iterations(const SignoriniProblem &problem,
                       const Sweep            &sweep,
                       const Vector           &right_hand_side,
                       const double            relaxation_factor,
                       const double            target,
                       const unsigned int      maximum_iterations)
  {
    Vector solution(right_hand_side), residual(right_hand_side);
    solution = 0.;

    double   norm = right_hand_side.linfty_norm();
    SorCount count;
    while (norm > target && count.iterations < maximum_iterations &&
           std::isfinite(norm))
      {
        sweep(right_hand_side, solution, relaxation_factor);
        problem.stiffness.vmult(residual, solution);
        residual -= right_hand_side;
        norm = residual.linfty_norm();
        ++count.iterations;
      }
    count.reached = (norm <= target);
    return count;
  }



  double
  find_relaxation_factor(const SignoriniProblem &problem,
                         const Sweep            &sweep,
                         const Vector           &right_hand_side,
                         const double            target,
                         const unsigned int      maximum_iterations)
  {
    // The finer the mesh, the nearer the optimum to 2, like 2 − h: the search
    // runs in y = −log₂(2 − ω), where y = −1 is ω = 0.
    const auto factor = [](const double y) { return 2. - std::exp2(-y); };

    // Coarse: whole y, all with few iterations; twice as many until some
    // factor reaches the target. None needs more than twice the best one.
    constexpr int n_coarse = 16;
    int           best     = -1;
    unsigned int  n_best   = maximum_iterations;
    for (std::size_t limit = 64; best < 0; limit *= 2)
      {
        for (int y = 0; y < n_coarse; ++y)
          {
            const SorCount count =
              count_sor_iterations(problem,
                                   sweep,
                                   right_hand_side,
                                   factor(y),
                                   target,
                                   std::min<std::size_t>(limit, n_best));
            if (count.reached && (best < 0 || count.iterations < n_best))
              {
                best   = y;
                n_best = count.iterations;
              }
          }
        if (best < 0 && limit >= maximum_iterations)
          throw NumericalError(
            "No relaxation factor was found with which SOR converges within "
            "[Contact] Maximum iterations = " +
            std::to_string(maximum_iterations) +
            ". Raise it, or give the factor as a number.");
      }

    // Fine: golden section between the neighbours of the best.
    const auto cost = [&](const double y) {
      const SorCount count = count_sor_iterations(
        problem, sweep, right_hand_side, factor(y), target, 4 * n_best);
      return count.reached ? count.iterations : 4 * n_best + 1;
    };
    const double golden = (std::sqrt(5.) - 1.) / 2.;
    double       left = best - 1., right = best + 1.;
    double       x      = right - golden * (right - left);
    double       y      = left + golden * (right - left);
    unsigned int cost_x = cost(x), cost_y = cost(y);
    while (right - left > 0.05)
      if (cost_x < cost_y)
        {
          right  = y;
          y      = x;
          cost_y = cost_x;
          x      = right - golden * (right - left);
          cost_x = cost(x);
        }
      else
        {
          left   = x;
          x      = y;
          cost_x = cost_y;
          y      = left + golden * (right - left);
          cost_y = cost(y);
        }
    return factor(cost_x < cost_y ? x : y);
  }
} // namespace Crevasse
