// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_creep_creep_law_h
#define crevasse_creep_creep_law_h

#include <crevasse/base/range.h>

#include <array>
#include <vector>

namespace Crevasse
{
  /** Parameter of creep laws in the section Material. Laws may share it. */
  struct CreepLawParameter
  {
    const char *name;
    const char *standard; ///< default value
    const char *meaning;  ///< description without its full stop
    Range       range;
  };

  /**
   * Nonlinear, volume-preserving creep law. The creep rate is
   *
   *     ε̇ᶜ = η₀(t)⁻¹ f(s) ε_c^(−m) N,      N = 3/2 dev σ / s,
   *
   * with the von Mises stress s of the stress σ and the accumulated creep
   * strain ε_c = ∫ √(2/3 ε̇ᶜ : ε̇ᶜ) dt. CreepPoint integrates the rate.
   * Selection<ViscosityType> lists all laws.
   */
  struct CreepLaw
  {
    /** Values of the parameters at a point and an instant. The first entry is
     * ln A, with the factor A of f. */
    using Constants = std::array<double, 3>;

    /** ln (f/s) and λ = d ln f / d ln s. λ must not decrease with s. */
    struct Response
    {
      double log_secant, slope;
    };

    /** Dual potential Ω = ∫₀ˢ f ds and its derivatives ∂Ω/∂c. */
    struct DualPotential
    {
      double    value;
      Constants slopes;
    };

    std::vector<CreepLawParameter> parameters;

    /** Response to a stress s, given as ln s. */
    Response (*response)(const Constants &c, const double log_stress);
    DualPotential (*dual_potential)(const Constants &c,
                                    const double     log_stress);

    /** Whether the last constant is m; without hardening m = 0. */
    bool hardens = false;

    /** Parameters of this law and an additional one. */
    std::vector<CreepLawParameter>
    parameters_and(const CreepLawParameter &more) const
    {
      std::vector<CreepLawParameter> all = parameters;
      all.push_back(more);
      return all;
    }

    /** λ as s tends to 0: determines how stress finally decays. */
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
   * Metals, 1965): a power law for small s, an exponential for large s. */
  const CreepLaw &
  hyperbolic_sine();

  /** f = A sⁿ with m ≥ 0 (Norton and Bailey, primary creep): under a constant
   * stress ε_c = ((1 + m) A sⁿ t)^(1/(1+m)). */
  const CreepLaw &
  strain_hardening();
} // namespace Crevasse

#endif
