// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_step_control_h
#define crevasse_time_step_control_h

#include <crevasse/time/integrator.h>
#include <crevasse/time/step_list.h>

namespace Crevasse
{
  /** A step of a period and what it works with. */
  struct PeriodStep
  {
    Integrator        &integrator;
    RateEquation      &f;
    StepList          &steps;
    const unsigned int k; ///< its number
    Vector            &r;
    Vector            &rate; ///< what Integrator::start() gives
  };

  /** Decides how far a step goes: this one takes the steps as they are. */
  class StepControl
  {
  public:
    /** @param stability_limit of the integrator, where the rate of relaxation
     * depends on the stress: steps at most as long as this over that rate. */
    explicit StepControl(const double stability_limit = no_stability_limit)
      : stability_limit(stability_limit)
    {
    }

    virtual ~StepControl() = default;

    /** Makes @p steps those of the next period, as far as they are known. */
    virtual void
    begin_period(StepList &)
    {
    }

    /** Integrator::start() at instant k. */
    virtual void
    start(const PeriodStep &step)
    {
      step.integrator.start(step.f,
                            step.steps.instant(step.k),
                            step.r,
                            step.rate);
    }

    /** Advances r from instant k, the last start, to instant k + 1 of the
     * steps, which may be divided for that.
     * @throw NumericalError if a step that is not is beyond the limit. */
    virtual void
    advance(const PeriodStep &step)
    {
      require_stability(step);
      step.integrator.advance({step.f,
                               step.steps.instant(step.k),
                               step.steps.step(step.k),
                               step.rate,
                               step.r});
    }

    /** Whether a period that is computed again has the same steps. */
    virtual bool
    repeats_steps() const
    {
      return true;
    }

    virtual IntegratorStatistics
    statistics() const
    {
      return {};
    }

    /** Shows what it has learned so far; nothing if it does not. */
    virtual void
    serialize(StateArchive &)
    {
    }

  protected:
    /** The longest stable step from the last evaluation on; infinite if the
     * material alone tells. Collective.
     * @throw NumericalError if a period takes too many of them. */
    double
    longest_stable(const PeriodStep &step) const;

  private:
    void
    require_stability(const PeriodStep &step) const;

    const double stability_limit;
  };

  /** @param smallest_relaxation_time bounds adaptive steps, which are none
   * longer than those of Steps per period.
   * @throw NumericalError if the steps are beyond the limit of the integrator,
   * and that is to be checked. */
  std::unique_ptr<StepControl>
  make_step_control(const TimeIntegrationParameters &parameters,
                    const StepList                  &steps,
                    const IntegratorProperties      &integrator,
                    const double                     smallest_relaxation_time);
} // namespace Crevasse

#endif
