// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_relaxation_factor_h
#define crevasse_contact_relaxation_factor_h

#include <crevasse/contact/signorini_problem.h>
#include <crevasse/contact/sweep.h>

namespace Crevasse
{
  /** Number of SOR iterations, from zero, until max|Aq − b| is at most
   * @p target (a force). */
  struct SorCount
  {
    unsigned int iterations = 0;
    bool         reached    = false;
  };

  SorCount
  count_sor_iterations(const SignoriniProblem &problem,
                       const Sweep            &sweep,
                       const Vector           &right_hand_side,
                       const double            relaxation_factor,
                       const double            target,
                       const unsigned int      maximum_iterations);

  /**
   * The relaxation factor that needs the fewest iterations, by dichotomy of
   * ]0,2[ (bracketing, then golden section) until 2 − ω is known to 3 % (paper,
   * §7: "dichotomic analysis of the interval"). To be called on the problem
   * without bounds, as the paper does.
   *
   * @param target the residual (a force) at which iterations are counted.
   * @throw NumericalError if no factor reaches it in maximum_iterations.
   */
  double
  find_relaxation_factor(const SignoriniProblem &problem,
                         const Sweep            &sweep,
                         const Vector           &right_hand_side,
                         const double            target,
                         const unsigned int      maximum_iterations);
} // namespace Crevasse

#endif
