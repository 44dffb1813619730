// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/contact/projected_sor.h>

#include <cmath>
#include <iomanip>
#include <sstream>
#include <utility>

namespace Crevasse
{
  ProjectedSor::ProjectedSor(const SignoriniProblem      &problem,
                             std::unique_ptr<const Sweep> sweep,
                             const double                 relaxation_factor,
                             const double                 tolerance,
                             const unsigned int           maximum_iterations)
    : ContactSolver(problem, tolerance)
    , sweep(std::move(sweep))
    , relaxation_factor(relaxation_factor)
    , maximum_iterations(maximum_iterations)
  {
  }



  std::string
  ProjectedSor::description() const
  {
    std::ostringstream text;
    text << std::setprecision(12) << "projected SOR with relaxation factor "
         << relaxation_factor;
    return text.str();
  }



  std::size_t
  ProjectedSor::iterate(const Vector &right_hand_side, Vector &solution)
  {
    // The residuals seen during a sweep only tell when a certificate, which
    // costs a matrix-vector product, is worth asking for.
    constexpr unsigned int sweeps_between_certificates = 10;
    scale_by(right_hand_side, solution);
    unsigned int n = 0;
    while (n < maximum_iterations)
      {
        const SweepCount count =
          sweep->sweep_until(right_hand_side,
                             solution,
                             relaxation_factor,
                             force_accuracy() * scales.force(),
                             maximum_iterations - n);
        n += count.sweeps;
        if (!std::isfinite(count.largest_residual) ||
            is_solved(right_hand_side, solution))
          return n;
        // Nothing is small enough, and this many sweeps are for nothing else.
        n += sweep
               ->sweep_until(right_hand_side,
                             solution,
                             relaxation_factor,
                             0.,
                             std::min(sweeps_between_certificates - 1,
                                      maximum_iterations - n))
               .sweeps;
      }
    return maximum_iterations;
  }
} // namespace Crevasse
