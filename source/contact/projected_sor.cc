// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/contact/projected_sor.h>

#include <cmath>

namespace Crevasse
{
  ProjectedSor::ProjectedSor(const SignoriniProblem &problem,
                             const double            relaxation_factor,
                             const double            tolerance,
                             const unsigned int      maximum_iterations)
    : ContactSolver(problem, tolerance)
    , sweep(problem)
    , relaxation_factor(relaxation_factor)
    , maximum_iterations(maximum_iterations)
  {
  }



  std::string
  ProjectedSor::description() const
  {
    return Text::Message() << "projected SOR with relaxation factor "
                           << relaxation_factor;
  }



  std::size_t
  ProjectedSor::iterate(const Vector &right_hand_side, Vector &solution)
  {
    // The residuals of a sweep only show when a certificate, which costs a
    // matrix-vector product, is worthwhile.
    constexpr unsigned int sweeps_between_certificates = 10;
    scale_by(right_hand_side, solution);
    unsigned int next_certificate = 0;
    for (unsigned int n = 1; n <= maximum_iterations; ++n)
      {
        const double residual =
          sweep(right_hand_side, solution, relaxation_factor);
        if (!std::isfinite(residual))
          return n;
        if (n < next_certificate ||
            residual > force_accuracy() * scales.force())
          continue;
        if (is_solved(right_hand_side, solution))
          return n;
        next_certificate = n + sweeps_between_certificates;
      }
    return maximum_iterations;
  }
} // namespace Crevasse
