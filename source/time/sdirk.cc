// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#include <crevasse/time/sdirk.h>

#include <deal.II/base/numbers.h>

#include <limits>

namespace Crevasse
{
  namespace
  {
    constexpr double gamma = 1. - dealii::numbers::SQRT1_2;
  }



  void
  Sdirk2::restart()
  {
    goes_on = false;
  }



  void
  Sdirk2::step(RateEquation                &f,
               const double                 t,
               const double                 time_step,
               Vector                      &r,
               const std::function<void()> &at_start)
  {
    rate.reinit(r, true);
    if (!goes_on)
      f.rate(t, r, rate);
    at_start();

    const double c = gamma * time_step;
    f.implicit_rate(t + c, r, c, rate);
    r.add((1. - gamma) * time_step, rate);
    f.implicit_rate(t + time_step, r, c, rate);
    r.add(c, rate);
    goes_on = true;
  }



  double
  Sdirk2::stability_limit() const
  {
    return std::numeric_limits<double>::infinity();
  }



  TimeQuadrature
  Sdirk2::quadrature() const
  {
    return {{gamma, 1.}, {1. - gamma, gamma}};
  }



  std::string
  Sdirk2::description() const
  {
    return "sdirk2";
  }
} // namespace Crevasse
