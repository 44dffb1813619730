// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_harmonic_balance_periodic_complementarity_h
#define crevasse_harmonic_balance_periodic_complementarity_h

#include <crevasse/harmonic_balance/periodic_contact_problem.h>
#include <crevasse/harmonic_balance/periodic_convolution.h>

#include <deal.II/lac/vector.h>

namespace Crevasse
{
  /** Forces g and openings w of p nodes at N instants, all nodes of the first
   * instant first, and offsets c of p nodes. */
  struct PeriodicState
  {
    dealii::Vector<double> forces;
    dealii::Vector<double> openings;
    dealii::Vector<double> offsets;
  };

  /**
   * A PeriodicContactProblem in the form that its solvers need: w⁰ as one
   * vector, without its mean in time, and the sizes by which errors are judged.
   */
  class PeriodicComplementarity
  {
  public:
    /** Keeps a reference to the convolution.
     * @throw ExceptionBase if sizes do not match, a number is not finite or a
     * mean force is not positive. */
    PeriodicComplementarity(const PeriodicContactProblem &problem,
                            const PeriodicConvolution    &convolution);

    /** w = w⁰ + S ∗ g + c of a state's forces and offsets. */
    void
    compute_openings(PeriodicState &state) const;

    /** The largest |g|, and no less than the largest mean. */
    double
    force_scale(const PeriodicState &state) const;

    /** The largest |w⁰|, plus what the largest force does by itself. */
    double
    opening_scale(const PeriodicState &state) const;

    /** The problem's form of a state; offsets are those of w⁰ with its mean. */
    PeriodicContactSolution
    solution(const PeriodicState &state) const;

    const PeriodicConvolution &convolution;
    dealii::Vector<double>     openings_without_contact; ///< w⁰, of mean 0
    dealii::Vector<double>     mean_openings; ///< of w⁰, for each node
    dealii::Vector<double>     mean_forces;   ///< ḡ for each node
  };
} // namespace Crevasse

#endif
