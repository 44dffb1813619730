// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

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
                // What pushes against the bound is a contact force; what a
                // moving unknown still lacks counts by its movement.
                next     = sign * gap;
                residual = diagonal[i] * (next - q[i]);
              }
          }
        q[i] = next;
        sum += next;
        largest_residual = std::max(largest_residual, std::abs(residual));
      }
    // A diverged iterate shows in the sum; the maximum would overlook nan.
    return std::isfinite(sum) ? largest_residual
                              : std::numeric_limits<double>::infinity();
  }
} // namespace Crevasse
