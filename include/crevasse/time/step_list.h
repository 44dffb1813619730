// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_step_list_h
#define crevasse_time_step_list_h

#include <crevasse/base/state_archive.h>
#include <crevasse/parameters/scene.h>

namespace Crevasse
{
  /** Instants 0 = t₀ < t₁ < … = T at which a period is sampled: M = 1 + number
   * of steps in the paper's count. Adaptive steps change as they are taken. */
  class StepList
  {
  public:
    /** Creates uniform steps, or the scene's list completed by 0 and the
     * period; for adaptive steps both, as a first guess.
     *
     * @param more instants at which adaptive steps end.
     * @param ends instants at which a step ends in any case. */
    StepList(const TimeIntegrationParameters &parameters,
             const double                     period,
             const std::vector<double>       &more = {},
             const std::vector<double>       &ends = {});

    /** Creates the steps of a scene. Adaptive steps also end at rows of the
     * tables over t that it calls, so that straight lines between fixed
     * instants miss little of them. */
    explicit StepList(const Scene &scene);

    /** Row of a table over t that straight lines between the ends of steps miss
     * most. */
    TableFunction::Miss
    missed(const TableFunction &table) const;

    /** Replaces all instants; the first is 0, the last the period. */
    void
    reset(const std::vector<double> &new_instants)
    {
      instants = new_instants;
    }

    /** Divides the step around @p t there. */
    void
    divide_at(const double t)
    {
      instants.insert(std::upper_bound(instants.begin(), instants.end(), t), t);
    }

    void
    serialize(StateArchive &archive)
    {
      archive.common(instants);
    }

    /** Sets the instants at which loads or material jump: a step that ends
     * there sees values before the jump, the next step values after it.
     * Adaptive steps always end there. */
    void
    set_jumps(const std::vector<double> &new_jumps);

    bool
    jumps_at(const double t) const;

    /** Instant just before @p t, for values before a jump. */
    double
    just_before(const double t) const
    {
      return t - 1e-11 * period();
    }

    unsigned int
    n_steps() const
    {
      return instants.size() - 1;
    }

    double
    period() const
    {
      return instants.back();
    }

    /** Instant k of the period, 0 ≤ k ≤ n_steps(). */
    double
    instant(const unsigned int k) const
    {
      return instants[k];
    }

    /** Instants at which steps always end: instants that the scene names, 0,
     * the period and jumps; with adaptive steps also those of equal steps. */
    const std::vector<double> &
    fixed_instants() const
    {
      return fixed;
    }

    double
    step(const unsigned int k) const
    {
      return instants[k + 1] - instants[k];
    }

    /** Whether all steps are equal up to rounding. */
    bool
    are_equal() const
    {
      return largest_step() * n_steps() < period() * (1. + 1e-9);
    }

    double
    largest_step() const;

    /** Beginnings and middles of all steps, and instants at the given fractions
     * of each step, all within the period: instants for checks of conditions on
     * the whole period. */
    std::vector<double>
    survey_instants(const std::vector<double> &fractions) const;

    /** Index of the step whose beginning is nearest to @p t, as if the period
     * were repeated. */
    unsigned int
    nearest(const double t) const;

    /** Maps a time to [0, T[, as loads and formulas are periodic. */
    double
    within_period(const double t) const
    {
      // A stage may end on the period up to rounding.
      const double rest = t - period() * std::floor(t / period());
      return rest >= period() * (1. - 1e-14) ? 0. : rest;
    }

  private:
    /** Divides steps at the rows of a table of which they would miss more than
     * @p allowed, the worst row first (Douglas and Peucker, Cartographica 10,
     * 1973). */
    void
    divide_at_rows(const TableFunction &table, const double allowed);

    /** Row of a table that the step @p k misses most. */
    TableFunction::Miss
    missed_by_step(const unsigned int k, const TableFunction &table) const
    {
      return table.missed_between(instant(k), just_before(instant(k + 1)));
    }

    std::vector<double> instants;
    std::vector<double> fixed;
    std::vector<double> jumps;
  };
} // namespace Crevasse

#endif
