// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_trapezoid_h
#define crevasse_time_trapezoid_h

#include <crevasse/time/integrator.h>

namespace Crevasse
{
  /**
   * The trapezoidal rule, of order 2 and A-stable:
   *
   *     r(t + Δt) = r + ½Δt f(r, t) + ½Δt f(r(t + Δt), t + Δt)
   *
   * Stiff components oscillate instead of decaying. With equal steps its
   * periodic state is that of the direct method in time.
   */
  class Trapezoid : public Integrator
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
      false;          ///< the last evaluation was at the last step's end
    Vector last_rate; ///< there
  };
} // namespace Crevasse

#endif
