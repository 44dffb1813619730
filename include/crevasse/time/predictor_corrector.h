// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_predictor_corrector_h
#define crevasse_time_predictor_corrector_h

#include <crevasse/time/integrator.h>

namespace Crevasse
{
  /**
   * A semi-implicit method of order 2, in the manner of those that the paper
   * compares (§6.2.1): Euler's method predicts r, the displacement is solved
   * for that, and the trapezoidal rule corrects r with this displacement,
   * implicitly in the stress that r relaxes:
   *
   *     r* = r + Δt f(r,t)
   *     r(t + Δt) = r + ½Δt [f(r,t) + η⁻¹ s(q(r*), r(t + Δt))]
   *
   * It costs what Heun's method costs, with the same A.
   */
  class PredictorCorrector : public Integrator
  {
  public:
    void
    advance(RateEquation &f,
            const double  t,
            const double  time_step,
            const Vector &rate,
            Vector       &r,
            Vector       *error) override;

    /** 6. If all relax alike there is none; it comes from where relaxing parts
     * are loaded by others. With two of them in parallel, of which one does not
     * flow and the other has the share p of the stiffness, a step multiplies
     * the viscous strain by (1 − z/2 + pz − p(1−p)z²/2) / (1 + z/2), z = Δt/τ;
     * its modulus is at most 1 for z up to 6 whatever p is (6 at p = 1/3). */
    double
    stability_limit() const override;

    TimeQuadrature
    quadrature() const override;

    std::string
    description() const override;

  private:
    Vector predicted, last_rate;
  };
} // namespace Crevasse

#endif
