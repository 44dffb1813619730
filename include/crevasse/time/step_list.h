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

#ifndef crevasse_time_step_list_h
#define crevasse_time_step_list_h

#include <crevasse/scene/parameters.h>

#include <vector>

namespace Crevasse
{
  /** The instants 0 = t₀ < t₁ < … = T at which a period is sampled: M = 1 +
   * number of steps in the paper's count. */
  class StepList
  {
  public:
    /** Uniform steps, or the scene's list completed by 0 and the period. Where
     * steps are adaptive these are the intervals between samples. */
    StepList(const TimeIntegrationParameters &parameters, const double period);

    unsigned int
    n_steps() const;

    double
    period() const;

    /** Instant k within the period, 0 ≤ k ≤ n_steps(). */
    double
    instant(const unsigned int k) const;

    double
    step(const unsigned int k) const;

    double
    largest_step() const;

    /** Beginnings and middles of all steps, and the instants at the given
     * fractions of each, all within the period: where what holds for the whole
     * period is looked at. */
    std::vector<double>
    survey_instants(const std::vector<double> &fractions) const;

    /** The step whose beginning is nearest to @p t, as if the period were
     * repeated. */
    unsigned int
    nearest(const double t) const;

    /** Brings a time into [0, T[: whatever is written is periodic. */
    double
    within_period(const double t) const;

    /** @throw NumericalError if the largest step is not below @p limit ×
     * @p smallest_relaxation_time, with both numbers and what to set; where
     * steps are adaptive, if steps below that are too many for a period. */
    void
    require_stability(const double limit,
                      const double smallest_relaxation_time) const;

  private:
    const bool          uniform, adaptive;
    std::vector<double> instants;
  };
} // namespace Crevasse

#endif
