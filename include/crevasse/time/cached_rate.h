// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_cached_rate_h
#define crevasse_time_cached_rate_h

#include <crevasse/time/rate_equation.h>

namespace Crevasse
{
  class StateArchive;

  /**
   * An equation that is not solved twice for the same instant and the same r:
   * what is shown at a sample often is what a method has evaluated last, or
   * evaluates next. The last evaluation for either is kept.
   */
  class CachedRate
  {
  public:
    /** From now on this equation is evaluated; it must live until the next
     * call. */
    void
    attach(RateEquation &new_equation)
    {
      equation = &new_equation;
    }

    /** Others have evaluated the equation. */
    void
    forget()
    {
      of_method.is_known = of_sample.is_known = false;
      latest                                  = nullptr;
    }

    /** f(r,t) for a method, to which only the rate matters.
     * @throw NumericalError if it is not finite. Collective. */
    void
    rate(const double t, const Vector &r, Vector &rate);

    /** The same, after which it is the equation's last evaluation: what that
     * has solved can be observed. */
    void
    show(const double t, const Vector &r, Vector &rate);

    /** f(r,t) for r = r̂ + c f(r,t), see RateEquation. */
    void
    implicit_rate(const double  t,
                  const Vector &known,
                  const double  c,
                  Vector       &rate)
    {
      evaluate(of_method, t, known, c, rate);
    }

    /** Of the last evaluation's instant. */
    const RateEquation &
    last() const
    {
      return *equation;
    }

    void
    serialize(StateArchive &archive);

  private:
    struct Evaluation
    {
      bool   is_known = false;
      double t        = 0.;
      Vector r, rate;

      bool
      is_of(const double time, const Vector &strain) const;
    };

    /** f(r,t) with r = @p known + @p c f(r,t). Keeps it, and its r. */
    void
    evaluate(Evaluation   &evaluation,
             const double  t,
             const Vector &known,
             const double  c,
             Vector       &rate);

    RateEquation     *equation = nullptr;
    Evaluation        of_method, of_sample;
    const Evaluation *latest = nullptr; ///< the equation's last
  };
} // namespace Crevasse

#endif
