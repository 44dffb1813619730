// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/state_archive.h>
#include <crevasse/time/trapezoid.h>

#include <limits>

namespace Crevasse
{
  void
  Trapezoid::restart()
  {
    is_continuing = false;
  }



  void
  Trapezoid::start(RateEquation &f,
                   const double  t,
                   const Vector &r,
                   Vector       &rate)
  {
    if (is_continuing)
      rate = last_rate;
    else
      f.rate(t, r, rate);
  }



  void
  Trapezoid::advance(RateEquation &f,
                     const double  t,
                     const double  time_step,
                     const Vector &rate,
                     Vector       &r,
                     Vector *)
  {
    last_rate.reinit(r, true);
    const double half = 0.5 * time_step;
    r.add(half, rate);
    f.implicit_rate(t + time_step, r, half, last_rate);
    r.add(half, last_rate);
    is_continuing = true;
  }



  double
  Trapezoid::stability_limit() const
  {
    return std::numeric_limits<double>::infinity();
  }



  TimeQuadrature
  Trapezoid::quadrature() const
  {
    return {{0., 1.}, {0.5, 0.5}};
  }



  std::string
  Trapezoid::description() const
  {
    return "trapezoid";
  }



  void
  Trapezoid::serialize(StateArchive &archive)
  {
    archive.common(is_continuing);
    archive.at_points(last_rate);
  }
} // namespace Crevasse
