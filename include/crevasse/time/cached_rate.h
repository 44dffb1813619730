// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_cached_rate_h
#define crevasse_time_cached_rate_h

#include <crevasse/time/rate_equation.h>

namespace Crevasse
{
  class StateArchive;

  /**
   * Avoids solving an equation twice for the same instant and r: a sample often
   * is the last or the next evaluation of a method. Stores the last evaluation
   * for a method and for a sample.
   */
  class CachedRate
  {
  public:
    /** Sets the equation to evaluate; it must live until the next call. */
    void
    attach(RateEquation &new_equation)
    {
      equation = &new_equation;
    }

    /** Forgets evaluations, because others have evaluated the equation. */
    void
    forget()
    {
      of_method.is_known = of_sample.is_known = false;
      latest                                  = nullptr;
    }

    /** Computes f(r,t) for a method, which only needs the rate.
     * @throw NumericalError if it is not finite. Collective. */
    void
    rate(const double t, const Vector &r, Vector &rate);

    /** Computes f(r,t) for a sample, as the equation's last evaluation: its
     * solution can then be observed. */
    void
    show(const double t, const Vector &r, Vector &rate);

    /** Computes f(r,t) for r = r̂ + c f(r,t), see RateEquation. */
    void
    implicit_rate(const double  t,
                  const Vector &known,
                  const double  c,
                  Vector       &rate)
    {
      evaluate(of_method, t, known, c, rate);
    }

    /** The equation, with the state of its last evaluation. */
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

    /** Computes f(r,t) with r = @p known + @p c f(r,t); keeps it with its r. */
    void
    evaluate(Evaluation   &evaluation,
             const double  t,
             const Vector &known,
             const double  c,
             Vector       &rate);

    RateEquation     *equation = nullptr;
    Evaluation        of_method, of_sample;
    const Evaluation *latest = nullptr; ///< last evaluation
  };
} // namespace Crevasse

#endif
