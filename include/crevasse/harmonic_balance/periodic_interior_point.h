// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_harmonic_balance_periodic_interior_point_h
#define crevasse_harmonic_balance_periodic_interior_point_h

#include <crevasse/harmonic_balance/periodic_complementarity.h>
#include <crevasse/harmonic_balance/periodic_system.h>

namespace Crevasse
{
  /**
   * Interior point method for PeriodicContactProblem: the predictor–corrector
   * of Mehrotra (SIAM J. Optim. 2, 1992) for monotone complementarity problems,
   *
   *     w = w⁰ + S ∗ g + c,    mean(g) = ḡ,    g w = μ → 0,    g, w > 0.
   *
   * Every step solves two systems (w/g + S) dg + dc = right with mean(dg) = 0.
   * The first two equations hold from the start, as any g = ḡ and a large c
   * satisfy them.
   */
  class PeriodicInteriorPoint
  {
  public:
    /** Keeps references; starts with g = ḡ. */
    PeriodicInteriorPoint(const PeriodicComplementarity &problem,
                          PeriodicSystem                &system);

    /** @throw NumericalError from PeriodicSystem. */
    void
    step();

    /** Mean of g w, relative to the scales. */
    double
    gap() const;

    /** Positive forces and openings. */
    const PeriodicState &
    state() const
    {
      return current;
    }

    unsigned int
    n_steps() const
    {
      return steps;
    }

  private:
    /** Solves for dg, dw and dc with w dg + g dw = right g. */
    PeriodicState
    direction(const dealii::Vector<double> &right);

    /** The longest step ≤ 1 at whose end no force or opening is negative. */
    double
    longest_step(const PeriodicState &direction) const;

    const PeriodicComplementarity &problem;
    PeriodicSystem                &system;
    const dealii::Vector<double>   no_means;
    PeriodicState                  current;
    unsigned int                   steps = 0;
  };
} // namespace Crevasse

#endif
