// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_period_map_h
#define crevasse_periodic_period_map_h

#include <crevasse/base/checkpointer.h>
#include <crevasse/time/evolution.h>
#include <crevasse/time/integrator.h>
#include <crevasse/time/observer.h>
#include <crevasse/time/step_control.h>
#include <crevasse/time/step_list.h>

#include <functional>

namespace Crevasse
{
  /** The map r(0) → r(T) of one period (the paper's Remark 2). */
  template <int dim>
  class PeriodMap
  {
  public:
    /** @param integrator nullptr for a body without viscosity, whose periods
     * are sequences of elastic states. All arguments must outlive this.
     * @param checkpointer called between steps; null: nobody wants to. */
    PeriodMap(Evolution<dim> &evolution,
              Integrator     *integrator,
              StepControl    &step_control,
              StepList       &steps,
              Checkpointer   *checkpointer = nullptr);

    /** Advances @p r over period @p period (1 for the first) and shows the
     * state at the beginning of every step. A resumed run continues in
     * the middle of another one. */
    void
    advance(unsigned int                               period,
            Vector                                    &r,
            const std::function<void(const Sample &)> &observe);

    /** Gives others the opportunity to keep the state from which advance()
     * would go on. */
    void
    stop_before(unsigned int period, Vector &r);

    /** Solves for the state at the end of @p period, which otherwise only the
     * next period would. */
    void
    finish(const unsigned int                         period,
           const Vector                              &r,
           const std::function<void(const Sample &)> &observe);

    const StepList &
    steps() const;

    Checkpointer *
    checkpointer() const;

    /** Whether a body remembers: without viscosity one period tells all. */
    bool
    has_memory() const;

  private:
    void
    serialize(StateArchive &archive,
              unsigned int &period,
              unsigned int &step,
              Vector       &r);

    void
    begin_period();

    /** Gives others the opportunity to keep or to exchange the state, if it
     * can be kept here. */
    void
    pause(const unsigned int period, const unsigned int step);

    /** What observers see where step @p k begins, or at the very end. */
    Sample
    sample(const unsigned int period,
           const unsigned int k,
           const Vector      &r) const;

    Evolution<dim> &evolution;
    Integrator     *integrator;
    StepControl    &step_control;
    StepList       &step_list;
    Checkpointer   *checkpointing;

    Vector rate; ///< at the beginning of a step
  };
} // namespace Crevasse

#endif
