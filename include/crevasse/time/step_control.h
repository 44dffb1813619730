// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_step_control_h
#define crevasse_time_step_control_h

#include <crevasse/time/integrator.h>
#include <crevasse/time/step_list.h>

namespace Crevasse
{
  /** A step of a period, with the objects that advance it. */
  struct PeriodStep
  {
    Integrator        &integrator;
    RateEquation      &f;
    StepList          &steps;
    const unsigned int k; ///< index of the step
    Vector            &r;
    Vector            &rate; ///< result of Integrator::start()
  };

  /** Decides the lengths of steps: this class takes the steps as given. */
  class StepControl
  {
  public:
    /** @param stability_limit of the integrator, if the relaxation rate depends
     * on the stress: the longest step is this limit over that rate. */
    explicit StepControl(const double stability_limit = no_stability_limit)
      : stability_limit(stability_limit)
    {
    }

    virtual ~StepControl() = default;

    /** Sets @p steps to the steps of the next period, as far as known. */
    virtual void
    begin_period(StepList &)
    {
    }

    /** Calls Integrator::start() at instant k. */
    virtual void
    start(const PeriodStep &step)
    {
      step.integrator.start(step.f,
                            step.steps.instant(step.k),
                            step.r,
                            step.rate);
    }

    /** Advances r from instant k, the last start, to instant k + 1 of the
     * steps, for which the step may be divided.
     * @throw NumericalError if an undivided step exceeds the limit. */
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

    /** Whether a recomputed period has the same steps. */
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

    /** Serialises data on the steps so far, if any. */
    virtual void
    serialize(StateArchive &)
    {
    }

  protected:
    /** Longest stable step after the last evaluation; infinite if only the
     * material limits it. Collective.
     * @throw NumericalError if a period takes too many such steps. */
    double
    longest_stable(const PeriodStep &step) const;

  private:
    void
    require_stability(const PeriodStep &step) const;

    const double stability_limit;
  };

  /** Creates the step control of a scene.
   * @param smallest_relaxation_time limits adaptive steps, which are at most as
   * long as those of Steps per period.
   * @throw NumericalError if steps to be checked exceed the stability limit. */
  std::unique_ptr<StepControl>
  make_step_control(const TimeIntegrationParameters &parameters,
                    const StepList                  &steps,
                    const IntegratorProperties      &integrator,
                    const double                     smallest_relaxation_time);
} // namespace Crevasse

#endif
