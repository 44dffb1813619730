// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_runge_kutta_h
#define crevasse_time_runge_kutta_h

#include <crevasse/time/butcher_tableau.h>
#include <crevasse/time/integrator.h>

#include <vector>

namespace Crevasse
{
  /** Any explicit Runge–Kutta method, driven by its tableau. */
  class RungeKutta : public Integrator
  {
  public:
    explicit RungeKutta(const ButcherTableau &tableau);

    void
    advance(RateEquation &f,
            const double  t,
            const double  time_step,
            const Vector &rate,
            Vector       &r,
            Vector       *error) override;

    bool
    has_error_estimate() const override;

    double
    stability_limit() const override
    {
      return tableau.real_stability_limit;
    }

    TimeQuadrature
    quadrature() const override;

    std::string
    description() const override
    {
      return tableau.name;
    }

  private:
    const ButcherTableau tableau;

    // Work space, given its size by the first step and kept.
    std::vector<Vector> rates; ///< but the first
    Vector              stage;
  };
} // namespace Crevasse

#endif
