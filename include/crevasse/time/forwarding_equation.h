// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_forwarding_equation_h
#define crevasse_time_forwarding_equation_h

#include <crevasse/time/rate_equation.h>

namespace Crevasse
{
  /** An equation with the instants of another one mapped: f(r, m(t)). */
  class ForwardingEquation : public RateEquation
  {
  public:
    explicit ForwardingEquation(RateEquation &equation);

    void
    rate(const double t, const Vector &r, Vector &rate) override;

    void
    implicit_rate(const double  t,
                  const Vector &known,
                  const double  c,
                  Vector       &rate) override;

    void
    semi_implicit_rate(const double  t,
                       const Vector &predicted,
                       const Vector &known,
                       const double  c,
                       Vector       &rate) override;

    void
    apply_relaxation(const unsigned int order,
                     const double       t,
                     const double       c,
                     Vector            &values) override;

    double
    stress_scale() const override;

    void
    strain_per_stress(const Vector &r, Vector &scale) const override;

    void
    switching_functions(std::vector<double> &values) const override;

  protected:
    /** m(t) */
    virtual double
    instant(const double t) const = 0;

  private:
    RateEquation &equation;
  };
} // namespace Crevasse

#endif
