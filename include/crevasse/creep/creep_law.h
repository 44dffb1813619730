// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_creep_creep_law_h
#define crevasse_creep_creep_law_h

#include <crevasse/base/range.h>

#include <array>
#include <vector>

namespace Crevasse
{
  /** A parameter of creep laws in the section Material. Laws may share it. */
  struct CreepLawParameter
  {
    const char *name;
    const char *standard; ///< default value
    const char *meaning;  ///< description without its full stop
    Range       range;
  };

  /**
   * A law of creep that is not linear in the stress and keeps the volume. The
   * creep rate is
   *
   *     ε̇ᶜ = η₀(t)⁻¹ f(s) ε_c^(−m) N,      N = 3/2 dev σ / s,
   *
   * with von Mises' stress s of the stress σ and the accumulated creep strain
   * ε_c = ∫ √(2/3 ε̇ᶜ : ε̇ᶜ) dt. CreepPoint integrates it. The table of
   * ViscosityType names all laws.
   */
  struct CreepLaw
  {
    /** Values of the parameters at a point and an instant; ln A instead of the
     * first one, which is the factor A of f. */
    using Constants = std::array<double, 3>;

    /** ln (f/s) and λ = d ln f / d ln s, which does not fall with s. */
    struct Response
    {
      double log_secant, slope;
    };

    /** Ω = ∫₀ˢ f ds, and ∂Ω/∂c. */
    struct DualPotential
    {
      double    value;
      Constants slopes;
    };

    std::vector<CreepLawParameter> parameters;

    /** Response to ln s. */
    Response (*response)(const Constants &c, const double log_stress);
    DualPotential (*dual_potential)(const Constants &c,
                                    const double     log_stress);

    /** Whether the last constant is m; otherwise m is 0. */
    bool hardens = false;

    /** Parameters of this law, and one more. */
    std::vector<CreepLawParameter>
    parameters_and(const CreepLawParameter &more) const
    {
      std::vector<CreepLawParameter> all = parameters;
      all.push_back(more);
      return all;
    }

    /** λ where s tends to 0, which tells how a stress dies out. */
    double
    least_exponent(const Constants &c) const
    {
      constexpr double log_of_none = -500.;
      return response(c, log_of_none).slope;
    }
  };

  /** f = A sⁿ (Norton and Odqvist). */
  const CreepLaw &
  power_law();

  /** f = A sinh(s/s₀)ⁿ (Garofalo, Fundamentals of Creep and Creep-Rupture in
   * Metals, 1965): a power law of small stresses, an exponential of large ones.
   */
  const CreepLaw &
  hyperbolic_sine();

  /** f = A sⁿ with m ≥ 0 (Norton and Bailey, primary creep): under a constant
   * stress ε_c = ((1 + m) A sⁿ t)^(1/(1+m)). */
  const CreepLaw &
  strain_hardening();
} // namespace Crevasse

#endif
