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

#include <crevasse/contact/relaxation_factor.h>
#include <crevasse/contact/sor_sweep.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Crevasse
{
  SorCount
  count_sor_iterations(const SignoriniProblem &problem,
                       const Vector           &right_hand_side,
                       const double            relaxation_factor,
                       const double            target,
                       const unsigned int      maximum_iterations)
  {
    const SorSweep sweep(problem);
    Vector         solution(right_hand_side), residual(right_hand_side);
    solution = 0.;

    double   norm = right_hand_side.linfty_norm(), norm_halfway = norm;
    SorCount count;
    while (norm > target && count.iterations < maximum_iterations &&
           std::isfinite(norm))
      {
        sweep(right_hand_side, solution, relaxation_factor);
        problem.matrix.vmult(residual, solution);
        residual -= right_hand_side;
        norm = residual.linfty_norm();
        ++count.iterations;
        if (count.iterations == maximum_iterations / 2)
          norm_halfway = norm;
      }

    // The first half of the iterations damps what any factor damps; the second
    // one shows the contraction that lasts.
    count.reached = (norm <= target);
    if (count.reached)
      count.expected = count.iterations;
    else if (norm < norm_halfway)
      count.expected = count.iterations + (count.iterations + 1) / 2 *
                                            (std::log(target / norm) /
                                             std::log(norm / norm_halfway));
    else
      count.expected = std::numeric_limits<double>::infinity();
    return count;
  }



  double
  find_relaxation_factor(const SignoriniProblem &problem,
                         const Vector           &right_hand_side,
                         const double            target,
                         const unsigned int      maximum_iterations)
  {
    // Far from the optimum thousands of iterations would tell no more than the
    // contraction seen in a few: the optimum needs of the order of √n.
    const auto enough = static_cast<unsigned int>(
      100 + 20 * std::sqrt(double(problem.matrix.m())));
    const auto cost = [&](const double factor) {
      return count_sor_iterations(problem,
                                  right_hand_side,
                                  factor,
                                  target,
                                  std::min(enough, maximum_iterations))
        .expected;
    };

    const double golden = (std::sqrt(5.) - 1.) / 2.;
    double       left = 0., right = 2.;
    double       x      = right - golden * (right - left);
    double       y      = left + golden * (right - left);
    double       cost_x = cost(x), cost_y = cost(y);
    while (right - left > 0.002)
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
    return cost_x < cost_y ? x : y;
  }
} // namespace Crevasse
