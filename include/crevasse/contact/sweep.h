// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_sweep_h
#define crevasse_contact_sweep_h

#include <crevasse/contact/signorini_problem.h>
#include <crevasse/linear/matrix_operator.h>

namespace Crevasse
{
  /** Number of SOR iterations from zero until max|Aq − b| is at most a target
   * (a force). */
  struct SorCount
  {
    unsigned int iterations = 0;
    bool         reached    = false;
  };

  /**
   * One sweep of successive overrelaxation in natural order, unknown by
   * unknown, with projection on the bounds: the paper's method (§6.1;
   * Glowinski, Lions, Trémolières 1976). On one process only.
   */
  class Sweep
  {
  public:
    /** @param problem Must outlive the sweep. */
    explicit Sweep(const SignoriniProblem &problem);

    /**
     * Overwrites @p solution by the next iterate and returns the largest
     * residual of a row at its update (a force; infinity if the iterate is not
     * finite). A row held at its bound counts by its movement. The residual is
     * cheap and close to the certificate, but not equal to it.
     */
    double
    operator()(const Vector &right_hand_side,
               Vector       &solution,
               const double  relaxation_factor) const;

    /** Number of iterations for a problem without bounds. */
    SorCount
    count_iterations(const Vector      &right_hand_side,
                     const double       relaxation_factor,
                     const double       target,
                     const unsigned int maximum_iterations) const;

    /**
     * Relaxation factor with the fewest iterations, by dichotomy of ]0,2[
     * (bracketing, then golden section) until 2 − ω is known to 3 % (paper, §7:
     * "dichotomic analysis of the interval"). Call this on the problem without
     * bounds, as the paper does.
     *
     * @param target Residual (a force) at which iterations are counted.
     * @throw NumericalError if no factor reaches it in maximum_iterations.
     */
    double
    best_factor(const Vector      &right_hand_side,
                const double       target,
                const unsigned int maximum_iterations) const;

  private:
    const SignoriniProblem &problem;
    const MatrixRows        rows;
    std::vector<int>        bound_of; ///< bound of each unknown, or −1
  };
} // namespace Crevasse

#endif
