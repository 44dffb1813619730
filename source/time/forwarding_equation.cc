// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/time/forwarding_equation.h>

namespace Crevasse
{
  ForwardingEquation::ForwardingEquation(RateEquation &equation)
    : equation(equation)
  {
  }



  void
  ForwardingEquation::rate(const double t, const Vector &r, Vector &rate)
  {
    equation.rate(instant(t), r, rate);
  }



  void
  ForwardingEquation::implicit_rate(const double  t,
                                    const Vector &known,
                                    const double  c,
                                    Vector       &rate)
  {
    equation.implicit_rate(instant(t), known, c, rate);
  }



  void
  ForwardingEquation::semi_implicit_rate(const double  t,
                                         const Vector &predicted,
                                         const Vector &known,
                                         const double  c,
                                         Vector       &rate)
  {
    equation.semi_implicit_rate(instant(t), predicted, known, c, rate);
  }



  void
  ForwardingEquation::apply_relaxation(const unsigned int order,
                                       const double       t,
                                       const double       c,
                                       Vector            &values)
  {
    equation.apply_relaxation(order, instant(t), c, values);
  }



  double
  ForwardingEquation::stress_scale() const
  {
    return equation.stress_scale();
  }



  void
  ForwardingEquation::strain_per_stress(const Vector &r, Vector &scale) const
  {
    equation.strain_per_stress(r, scale);
  }



  void
  ForwardingEquation::switching_functions(std::vector<double> &values) const
  {
    equation.switching_functions(values);
  }
} // namespace Crevasse
