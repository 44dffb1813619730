// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_observer_h
#define crevasse_time_observer_h

#include <crevasse/base/summary.h>
#include <crevasse/time/state.h>

#include <cstddef>

namespace Crevasse
{
  /** State of a run at one instant, for tables and fields. */
  struct Sample
  {
    unsigned int period; ///< period number, from 1
    unsigned int step;   ///< 0 … n_steps; n_steps only at the end
    double       time;   ///< time since the start of the run
    /** Time within the period; the whole period at the end of the run. */
    double instant;

    const State  &state;
    const Vector &viscous_strain;
    const Vector &right_hand_side; ///< loads b of contact problem
    /** Flow that was split off from displacement and viscous strain; null:
     * none. */
    const SecularFlow *secular_flow;
  };

  /** Results of a period, known at its end. */
  struct PeriodReport
  {
    unsigned int period;
    double       end_time;
    /** Largest change of a stress component from the period before, over all
     * samples and quadrature points, relative to the largest stress. The first
     * period is compared with the unstressed state before it. */
    double stress_change;
    /** Estimated distance to the periodic stress, by the method of the search;
     * nan if unknown. */
    double       stress_error_estimate;
    double       judged_error; ///< the same of what ends the search
    double       largest_stress;
    std::size_t  vi_solves;   ///< solves in this period
    double       seconds;     ///< seconds for this period
    unsigned int mission = 0; ///< number of the mission; 0: none
  };

  /** Receives every accepted step and every period of a run. */
  class Observer
  {
  public:
    virtual ~Observer() = default;

    virtual void
    observe(const Sample &sample) = 0;

    /** Receives the state just before a jump of loads or material at the end of
     * a step; observe() receives the state after it. */
    virtual void
    before_jump(const Sample &)
    {
    }

    /** Receives, after the last period and before summarise(), the state at an
     * instant of this period within a step at which a lip opens or closes:
     * quantities have kinks there. Collective. */
    virtual void
    between(const Sample &)
    {
    }

    virtual void
    end_of_period(const PeriodReport &)
    {
    }

    /** Adds the observer's part of the summary after the last period, in the
     * order of creation of observers, and prints it. Collective. */
    virtual void
    summarise(Summary &)
    {
    }

    /** Checks, after summarise(), a state whose stress repeats. Collective.
     * @throw NumericalError with advice if it cannot be the periodic one. */
    virtual void
    require_periodic() const
    {
    }

    /** Writes final results after summarise(). Collective. */
    virtual void
    finish()
    {
    }

    /** Serialises the observer's memory besides files, if any. */
    virtual void
    serialize(StateArchive &)
    {
    }
  };
} // namespace Crevasse

#endif
