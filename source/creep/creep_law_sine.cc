// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/creep/creep_law.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  namespace
  {
    /** Logarithm ln sinh u for u > 0. */
    double
    log_sinh(const double u)
    {
      return u + std::log(-0.5 * std::expm1(-2. * u));
    }



    CreepLaw::Response
    sine_response(const CreepLaw::Constants &c, const double log_stress)
    {
      const double u = std::max(std::exp(log_stress) / c[2],
                                std::numeric_limits<double>::min());
      return {c[0] + c[1] * log_sinh(u) - log_stress, c[1] * u / std::tanh(u)};
    }



    /** Integrates by Gauss' rule over the stresses that matter: below s, f(u)
     * decays at least like exp(−n (s − u)/s₀). */
    CreepLaw::DualPotential
    sine_dual_potential(const CreepLaw::Constants &c, const double log_stress)
    {
      constexpr double                  negligible = 40.;
      static const dealii::QIterated<1> rule(dealii::QGauss<1>(16), 8);
      const auto [log_a, n, s_0] = c;
      const double s             = std::exp(log_stress);
      const double length        = std::min(s, negligible * s_0 / n);
      double       whole = 0., of_n = 0.;
      for (unsigned int q = 0; q < rule.size(); ++q)
        {
          const double log_g = log_sinh((s - length * rule.point(q)[0]) / s_0);
          const double part =
            rule.weight(q) * length * std::exp(log_a + n * log_g);
          whole += part;
          of_n += part * log_g;
        }
      const double f = std::exp(log_a + n * log_sinh(s / s_0));
      return {whole, {{whole, of_n, (whole - s * f) / s_0}}};
    }
  } // namespace



  const CreepLaw &
  hyperbolic_sine()
  {
    static const CreepLaw law = {power_law().parameters_and(
                                   {"Reference stress",
                                    "0", // must be set
                                    "Stress s0 that divides the stress in the "
                                    "hyperbolic sine, in units of stress",
                                    Ranges::positive}),
                                 sine_response,
                                 sine_dual_potential};
    return law;
  }
} // namespace Crevasse
