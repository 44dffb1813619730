// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_sdirk_h
#define crevasse_time_sdirk_h

#include <crevasse/time/integrator.h>

namespace Crevasse
{
  /**
   * The L-stable diagonally implicit method of two stages and order 2
   * (Alexander, SIAM J. Numer. Anal. 14, 1977), γ = 1 − √2/2:
   *
   *     r₁ = r + γΔt f(r₁, t + γΔt)
   *     r₂ = r + (1−γ)Δt f₁ + γΔt f(r₂, t + Δt),     r(t + Δt) = r₂
   *
   * Its last stage is the state at the end of the step: one that goes on from
   * there needs no evaluation of its own to show it.
   */
  class Sdirk2 : public Integrator
  {
  public:
    void
    restart() override;

    void
    start(RateEquation &f,
          const double  t,
          const Vector &r,
          Vector       &rate) override;

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

    bool
    has_matrix_of_step() const override
    {
      return true;
    }

    double
    stability_limit() const override;

    TimeQuadrature
    quadrature() const override;

    std::string
    description() const override;

    void
    serialize(StateArchive &archive) override;

  private:
    bool is_continuing =
      false; ///< the last evaluation was at the last step's end
    Vector stage_rate;
  };
} // namespace Crevasse

#endif
