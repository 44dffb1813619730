// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/contact/sweep.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Crevasse
{
  Sweep::Sweep(const SignoriniProblem &problem)
    : problem(problem)
    , rows(problem.matrix())
    , bound_of(rows.n, -1)
  {
    for (unsigned int k = 0; k < problem.bounds.dofs.size(); ++k)
      bound_of[problem.bounds.dofs[k]] = k;
  }



  double
  Sweep::operator()(const Vector &right_hand_side,
                    Vector       &solution,
                    const double  relaxation_factor) const
  {
    double *const       q        = solution.begin();
    const double *const b        = right_hand_side.begin();
    const double *const diagonal = problem.diagonal().begin();

    double largest_residual = 0., sum = 0.;
    for (int i = 0; i < rows.n; ++i)
      {
        double residual = b[i];
        for (int k = rows.starts[i]; k < rows.starts[i + 1]; ++k)
          residual -= rows.values[k] * q[rows.columns[k]];

        double    next  = q[i] + relaxation_factor * residual / diagonal[i];
        const int bound = bound_of[i];
        if (bound >= 0)
          {
            const double sign = problem.bounds.sign[bound];
            const double gap  = problem.bounds.gap[bound];
            if (sign * next <= gap)
              {
                // A residual against the bound is a contact force; a moving
                // unknown counts by its movement.
                next     = sign * gap;
                residual = diagonal[i] * (next - q[i]);
              }
          }
        q[i] = next;
        sum += next;
        largest_residual = std::max(largest_residual, std::abs(residual));
      }
    // The sum reveals a diverged iterate; the maximum would ignore NaN.
    return std::isfinite(sum) ? largest_residual
                              : std::numeric_limits<double>::infinity();
  }



  SorCount
  Sweep::count_iterations(const Vector      &right_hand_side,
                          const double       relaxation_factor,
                          const double       target,
                          const unsigned int maximum_iterations) const
  {
    Vector solution(right_hand_side), residual(right_hand_side);
    solution = 0.;

    double   norm = right_hand_side.linfty_norm();
    SorCount count;
    while (norm > target && count.iterations < maximum_iterations &&
           std::isfinite(norm))
      {
        (*this)(right_hand_side, solution, relaxation_factor);
        problem.stiffness.vmult(residual, solution);
        residual -= right_hand_side;
        norm = residual.linfty_norm();
        ++count.iterations;
      }
    count.reached = (norm <= target);
    return count;
  }



  double
  Sweep::best_factor(const Vector      &right_hand_side,
                     const double       target,
                     const unsigned int maximum_iterations) const
  {
    // The optimal factor approaches 2 like 2 − h: the search uses y = −log₂(2 −
    // ω), where y = −1 is ω = 0.
    const auto factor = [](const double y) { return 2. - std::exp2(-y); };

    // Coarse search: integer y, all with few iterations; then twice as many
    // until some factor reaches the target: at most twice the best number.
    constexpr int n_coarse = 16;
    int           best     = -1;
    unsigned int  n_best   = maximum_iterations;
    for (std::size_t limit = 64; best < 0; limit *= 2)
      {
        for (int y = 0; y < n_coarse; ++y)
          {
            const SorCount count =
              count_iterations(right_hand_side,
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
            ". Raise it, or set Relaxation factor to a number.");
      }

    // Fine search: golden section between the neighbours of the best.
    const auto cost = [&](const double y) {
      const SorCount count =
        count_iterations(right_hand_side, factor(y), target, 4 * n_best);
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
