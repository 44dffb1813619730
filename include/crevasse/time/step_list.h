// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_step_list_h
#define crevasse_time_step_list_h

#include <crevasse/base/state_archive.h>
#include <crevasse/parameters/scene.h>

namespace Crevasse
{
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

    /** The steps that a scene asks for. */
    explicit StepList(const Scene &scene)
      : StepList(scene.time_integration,
                 scene.loads.period,
                 scene.output.field_times->instants(scene.loads.period))
    {
    }

    /** Replaces all instants; the first is 0, the last the period. */
    void
    reset(const std::vector<double> &new_instants)
    {
      instants = new_instants;
    }

    /** Ends step @p k at @p t, where a new one begins. */
    void
    divide(const unsigned int k, const double t)
    {
      instants.insert(instants.begin() + k + 1, t);
    }

    void
    serialize(StateArchive &archive)
    {
      archive.common(instants);
    }

    /** Makes known that loads or material jump at these instants: a step that
     * ends there sees what was before, the next one what comes after. Adaptive
     * steps end there in any case. */
    void
    set_jumps(const std::vector<double> &new_jumps);

    bool
    jumps_at(const double t) const;

    /** By so little that nothing changes but by a jump. */
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

    /** Instant k within the period, 0 ≤ k ≤ n_steps(). */
    double
    instant(const unsigned int k) const
    {
      return instants[k];
    }

    /** Instants at which steps end in any case: those that the scene names, 0,
     * the period and jumps; where steps are adaptive, those of equal steps as
     * well. */
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
    within_period(const double t) const
    {
      // A stage may end on the period but for rounding.
      const double rest = t - period() * std::floor(t / period());
      return rest >= period() * (1. - 1e-14) ? 0. : rest;
    }

  private:
    std::vector<double> instants;
    std::vector<double> fixed;
    std::vector<double> jumps;
  };
} // namespace Crevasse

#endif
