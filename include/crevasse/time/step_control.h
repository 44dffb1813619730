// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_step_control_h
#define crevasse_time_step_control_h

#include <crevasse/time/integrator.h>
#include <crevasse/time/step_list.h>

namespace Crevasse
{
  /** Decides how far a step goes. */
  class StepControl
  {
  public:
    virtual ~StepControl() = default;

    /** Makes @p steps those of the next period, as far as they are known. */
    virtual void
    begin_period(StepList &steps) = 0;

    /** Integrator::start() at instant @p k. */
    virtual void
    start(Integrator        &integrator,
          RateEquation      &f,
          const StepList    &steps,
          const unsigned int k,
          const Vector      &r,
          Vector            &rate);

    /**
     * Advances r from instant @p k, the last start, to instant k + 1 of the
     * steps, which may be divided for that.
     *
     * @param rate what Integrator::start() gave.
     */
    virtual void
    advance(Integrator        &integrator,
            RateEquation      &f,
            StepList          &steps,
            const unsigned int k,
            const Vector      &rate,
            Vector            &r) = 0;

    virtual IntegratorStatistics
    statistics() const = 0;

    /** Shows what it has learned so far; nothing if it does not. */
    virtual void
    serialize(StateArchive &);
  };

  /** Takes the steps as they are. */
  class FixedSteps : public StepControl
  {
  public:
    void
    begin_period(StepList &steps) override;

    void
    advance(Integrator        &integrator,
            RateEquation      &f,
            StepList          &steps,
            const unsigned int k,
            const Vector      &rate,
            Vector            &r) override;

    IntegratorStatistics
    statistics() const override
    {
      return {};
    }
  };
} // namespace Crevasse

#endif
