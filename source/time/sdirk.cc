// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/state_archive.h>
#include <crevasse/time/sdirk.h>

#include <deal.II/base/numbers.h>

#include <limits>

namespace Crevasse
{
  namespace
  {
    constexpr double gamma = 1. - dealii::numbers::SQRT1_2;
    // The embedded method of order 1 has the weights (1−a, a), a = 2 − 5√2/4
    // (Ellsiepen, 1999); γ − a is the difference.
    constexpr double error_weight =
      gamma - (2. - 1.25 * dealii::numbers::SQRT2);
  } // namespace



  void
  Sdirk2::restart()
  {
    is_continuing = false;
  }



  void
  Sdirk2::start(RateEquation &f, const double t, const Vector &r, Vector &rate)
  {
    if (!is_continuing)
      f.rate(t, r, rate);
  }



  void
  Sdirk2::advance(RateEquation &f,
                  const double  t,
                  const double  time_step,
                  const Vector &,
                  Vector &r,
                  Vector *error)
  {
    stage_rate.reinit(r, true);
    const double c = gamma * time_step;
    f.implicit_rate(t + c, r, c, stage_rate);
    r.add((1. - gamma) * time_step, stage_rate);
    if (error != nullptr)
      error->add(-error_weight * time_step, stage_rate);
    f.implicit_rate(t + time_step, r, c, stage_rate);
    r.add(c, stage_rate);
    if (error != nullptr)
      error->add(error_weight * time_step, stage_rate);
    is_continuing = true;
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



  void
  Sdirk2::serialize(StateArchive &archive)
  {
    archive.common(is_continuing);
  }
} // namespace Crevasse
