// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_step_list_h
#define crevasse_time_step_list_h

#include <crevasse/parameters/parameters.h>

#include <vector>

namespace Crevasse
{
  class StateArchive;

  /** The instants 0 = t₀ < t₁ < … = T at which a period is sampled: M = 1 +
   * number of steps in the paper's count. Adaptive steps change while they are
   * taken. */
  class StepList
  {
  public:
    /** Uniform steps, or the scene's list completed by 0 and the period; for
     * adaptive steps both, as a first guess.
     *
     * @param more instants at which steps end if they are adaptive. */
    StepList(const TimeIntegrationParameters &parameters,
             const double                     period,
             const std::vector<double>       &more = {});

    /** Replaces all instants; the first is 0, the last the period. */
    void
    reset(const std::vector<double> &new_instants);

    /** Ends step @p k at @p t, where a new one begins. */
    void
    divide(const unsigned int k, const double t);

    /** Shows all instants. */
    void
    serialize(StateArchive &archive);

    /** Makes known that loads or material jump at these instants: a step that
     * ends there sees what was before, the next one what comes after. */
    void
    set_jumps(const std::vector<double> &instants);

    bool
    jumps_at(const double t) const;

    /** By so little that nothing changes but by a jump. */
    double
    just_before(const double t) const;

    unsigned int
    n_steps() const;

    double
    period() const;

    /** Instant k within the period, 0 ≤ k ≤ n_steps(). */
    double
    instant(const unsigned int k) const;

    /** Those instants that the scene asks for by name, 0 and the period. */
    const std::vector<double> &
    fixed_instants() const
    {
      return fixed;
    }

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
     * @p smallest_relaxation_time, with both numbers and what to set. */
    void
    require_stability(const double limit,
                      const double smallest_relaxation_time) const;

    /** @throw NumericalError if steps of at most this length are too many. */
    void
    require_possible(const double longest_step) const;

  private:
    static double
    within_period(const double t, const double period);

    const bool          uniform;
    std::vector<double> instants;
    std::vector<double> fixed;
    std::vector<double> jumps;
  };
} // namespace Crevasse

#endif
