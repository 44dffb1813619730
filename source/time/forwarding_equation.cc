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
