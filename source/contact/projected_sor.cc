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
    unsigned int           next_certificate            = 0;
    scale_by(right_hand_side, solution);
    for (unsigned int n = 1; n <= maximum_iterations; ++n)
      {
        const double seen =
          (*sweep)(right_hand_side, solution, relaxation_factor);
        if (!std::isfinite(seen))
          return n;
        if (seen <= force_accuracy() * scales.force() && n >= next_certificate)
          {
            if (is_solved(right_hand_side, solution))
              return n;
            next_certificate = n + sweeps_between_certificates;
          }
      }
    return maximum_iterations;
  }
} // namespace Crevasse
