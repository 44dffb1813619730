// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/harmonic_balance/harmonics.h>

#include <deal.II/base/numbers.h>

#include <cmath>

namespace Crevasse
{
  using namespace dealii;

  Harmonics::Harmonics(const double       period,
                       const unsigned int n,
                       const HarmonicRule rule)
    : n_instants(n)
    , period(period)
    , rule(rule)
    , analysis(1 + 2 * n_harmonics(), n)
    , synthesis(n, 1 + 2 * n_harmonics())
  {
    for (unsigned int j = 0; j < n; ++j)
      {
        analysis(0, j)  = 1. / n;
        synthesis(j, 0) = 1.;
        for (unsigned int k = 1; k <= n_harmonics(); ++k)
          {
            // Multiples of the period are removed before rounding.
            const double phase  = 2. * numbers::PI * ((j * k) % n) / n;
            const double weight = (is_real(k) ? 1. : 2.) / n;

            synthesis(j, 2 * k - 1) = std::cos(phase);
            synthesis(j, 2 * k)     = is_real(k) ? 0. : -std::sin(phase);
            analysis(2 * k - 1, j)  = weight * synthesis(j, 2 * k - 1);
            analysis(2 * k, j)      = weight * synthesis(j, 2 * k);
          }
      }
  }



  std::complex<double>
  Harmonics::integral(const unsigned int n) const
  {
    if (rule == HarmonicRule::exact)
      return {0., -period / (2. * numbers::PI * n)};
    if (is_real(n))
      return 0.;
    return {0.,
            -0.5 * period / n_instants /
              std::tan(numbers::PI * n / n_instants)};
  }
} // namespace Crevasse
