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

#ifndef crevasse_time_remembered_rate_h
#define crevasse_time_remembered_rate_h

#include <crevasse/time/rate_equation.h>

#include <cstddef>

namespace Crevasse
{
  /**
   * An equation that does not solve twice in succession for the same instant
   * and the same r: what is shown at a sample often is what a method has
   * evaluated last, or evaluates next.
   */
  class RememberedRate
  {
  public:
    /** From now on this equation is evaluated; it must live until the next
     * call. */
    void
    attach(RateEquation &equation);

    /** The next evaluation is not the last one's, whatever r is: others have
     * evaluated the equation. */
    void
    forget();

    /** f(r,t); afterwards it is the equation's last evaluation.
     * @throw NumericalError if it is not finite. Collective. */
    void
    rate(const double t, const Vector &r, Vector &rate);

    /** f(r,t) for r = r̂ + c f(r,t), see RateEquation. */
    void
    implicit_rate(const double  t,
                  const Vector &known,
                  const double  c,
                  Vector       &rate);

    /** Of the last evaluation's instant. */
    const RateEquation &
    last() const;

    /** Without those that were remembered. */
    std::size_t
    n_evaluations() const;

  private:
    bool
    is_remembered(const double t, const Vector &r) const;

    void
    remember(const double t, const Vector &rate);

    RateEquation *equation = nullptr;
    bool          knows    = false;
    double        last_t   = 0.;
    Vector        last_r, last_rate;
    std::size_t   evaluations = 0;
  };
} // namespace Crevasse

#endif
