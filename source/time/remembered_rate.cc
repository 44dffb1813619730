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

#include <crevasse/scene/problems.h>
#include <crevasse/time/remembered_rate.h>

#include <cmath>
#include <sstream>

namespace Crevasse
{
  void
  RememberedRate::attach(RateEquation &new_equation)
  {
    equation = &new_equation;
  }



  void
  RememberedRate::forget()
  {
    knows = false;
  }



  bool
  RememberedRate::is_remembered(const double t, const Vector &r) const
  {
    // The last stage of a step is its end but for the order of summation.
    constexpr double rounding = 1e-13;
    if (!knows || std::abs(t - last_t) > rounding * std::abs(t))
      return false;
    Vector difference = r;
    difference -= last_r;
    return difference.linfty_norm() <= rounding * last_r.linfty_norm();
  }



  void
  RememberedRate::remember(const double t, const Vector &rate)
  {
    ++evaluations;
    if (!std::isfinite(rate.l1_norm()))
      {
        knows = false;
        std::ostringstream message;
        message << "At t = " << t
                << " the rate of the viscous strain is not finite. Look at the "
                   "formulas of [Material] and [Loads] at this instant.";
        throw NumericalError(message.str());
      }
    last_t    = t;
    last_rate = rate;
    knows     = true;
  }



  void
  RememberedRate::rate(const double t, const Vector &r, Vector &rate)
  {
    if (is_remembered(t, r))
      {
        rate = last_rate;
        return;
      }
    knows = false;
    equation->rate(t, r, rate);
    last_r = r;
    remember(t, rate);
  }



  void
  RememberedRate::implicit_rate(const double  t,
                                const Vector &known,
                                const double  c,
                                Vector       &rate)
  {
    knows = false;
    equation->implicit_rate(t, known, c, rate);
    last_r = known;
    last_r.add(c, rate);
    remember(t, rate);
  }



  const RateEquation &
  RememberedRate::last() const
  {
    return *equation;
  }



  std::size_t
  RememberedRate::n_evaluations() const
  {
    return evaluations;
  }
} // namespace Crevasse
