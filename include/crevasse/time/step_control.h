// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_step_control_h
#define crevasse_time_step_control_h

#include <crevasse/time/integrator.h>
#include <crevasse/time/step_list.h>

#include <memory>
#include <utility>

namespace Crevasse
{
  /** Integrator that takes the steps of a period by a method, after checking
   * the stability of each step. */
  class StepControl : public Integrator
  {
  public:
    /** @param steps must outlive the StepControl.
     * @param stability_limit limit of the method if the relaxation rate depends
     * on the stress: the longest step is limit / rate. */
    StepControl(std::unique_ptr<Integrator> &&method,
                const IntegratorProperties   &properties,
                StepList                     &steps,
                const double                  stability_limit)
      : Integrator(properties)
      , method(std::move(method))
      , steps(steps)
      , stability_limit(stability_limit)
    {
    }

    void
    restart() override
    {
      method->restart();
    }

    void
    start(RateEquation &f,
          const double  t,
          const Vector &r,
          Vector       &rate) override
    {
      method->start(f, t, r, rate);
    }

    /** @throw NumericalError if the step exceeds the limit. */
    void
    advance(const TimeStep &step) override
    {
      require_stability(step);
      method->advance(step);
    }

    void
    serialize(StateArchive &archive) override
    {
      method->serialize(archive);
    }

    IntegratorStatistics
    statistics() const override
    {
      return method->statistics();
    }

  protected:
    /** Longest stable step after the last evaluation; infinite if only the
     * material limits it. Collective.
     * @throw NumericalError if a period takes too many such steps. */
    double
    longest_stable(const TimeStep &step) const;

    const std::unique_ptr<Integrator> method;
    StepList                         &steps;

  private:
    void
    require_stability(const TimeStep &step) const;

    const double stability_limit;
  };

  /** Makes a method take the steps of a scene.
   * @param steps must outlive the result, which changes adaptive steps.
   * @param smallest_relaxation_time limits adaptive steps, besides Steps per
   * period.
   * @throw NumericalError if fixed steps exceed the stability limit. */
  std::unique_ptr<Integrator>
  control_steps(std::unique_ptr<Integrator>    &&method,
                const TimeIntegrationParameters &parameters,
                StepList                        &steps,
                const double                     smallest_relaxation_time);
} // namespace Crevasse

#endif
