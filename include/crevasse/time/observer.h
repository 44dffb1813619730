// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_observer_h
#define crevasse_time_observer_h

#include <crevasse/base/summary.h>
#include <crevasse/time/secular_flow.h>
#include <crevasse/time/state.h>

#include <cstddef>

namespace Crevasse
{
  /** One instant of a run, as the tables and fields see it. */
  struct Sample
  {
    unsigned int period; ///< 1 for the first
    unsigned int step;   ///< 0 … n_steps; n_steps only at the very end
    double       time;   ///< goes on over the periods
    /** Within the period, the same in each; the period at the very end. */
    double instant;

    const State  &state;
    const Vector &viscous_strain;
    const Vector &right_hand_side; ///< b of the contact problem
    /** What is not in displacement and viscous strain, because it was split
     * off; null: nothing. */
    const SecularFlow *secular_flow;
  };

  /** What is known at the end of a period. */
  struct PeriodReport
  {
    unsigned int period;
    double       end_time;
    /** Largest change of a stress component against the period before, over
     * all samples and quadrature points, relative to the largest stress. The
     * first period is compared with the unstressed state before it. */
    double stress_change;
    /** Distance of this stress to the periodic one, as the method estimates it;
     * nan while it cannot be told. */
    double      stress_error_estimate;
    double      largest_stress;
    std::size_t vi_solves; ///< of this period
    double      seconds;   ///< of this period
  };

  /** Sees every accepted step and every period of a run. */
  class Observer
  {
  public:
    virtual ~Observer() = default;

    virtual void
    observe(const Sample &sample) = 0;

    /** Sees the end of a step where loads or material jump, as they are just
     * before; observe() sees what comes after. */
    virtual void
    before_jump(const Sample &)
    {
    }

    virtual void
    end_of_period(const PeriodReport &)
    {
    }

    /** Adds its part of the summary, after the last period, in the order in
     * which observers were made; prints and writes what it has kept for the
     * end. Collective. */
    virtual void
    summarise(Summary &)
    {
    }

    /** Shows what it remembers, besides files; nothing if it does not. */
    virtual void
    serialize(StateArchive &)
    {
    }
  };
} // namespace Crevasse

#endif
