// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/time/exponential_heun.h>

#include <limits>

namespace Crevasse
{
  void
  ExponentialHeun::advance(RateEquation &f,
                           const double  t,
                           const double  time_step,
                           const Vector &rate,
                           Vector       &r,
                           Vector       *error)
  {
    second_rate.reinit(r, true);
    increment = rate;
    f.apply_relaxation(1, t, time_step, increment);
    increment *= time_step;
    r += increment;
    f.rate(t + time_step, r, second_rate);

    // Into one vector: Δt φ₂ [f(a) − f(r)] + d − φ₁ d.
    second_rate -= rate;
    f.apply_relaxation(2, t, time_step, second_rate);
    second_rate *= time_step;
    second_rate += increment;
    f.apply_relaxation(1, t, time_step, increment);
    second_rate -= increment;
    r += second_rate;
    if (error != nullptr)
      *error += second_rate;
  }



  double
  ExponentialHeun::stability_limit() const
  {
    return std::numeric_limits<double>::infinity();
  }



  TimeQuadrature
  ExponentialHeun::quadrature() const
  {
    // How the two rates are weighted depends on the relaxation.
    return {{0., 1.}, {}};
  }



  std::string
  ExponentialHeun::description() const
  {
    return "exponential";
  }
} // namespace Crevasse
