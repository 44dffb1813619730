// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_periodic_search_h
#define crevasse_periodic_periodic_search_h

#include <crevasse/base/log.h>
#include <crevasse/harmonic_balance/fourier_problem.h>
#include <crevasse/model/body.h>
#include <crevasse/model/secular_problem.h>
#include <crevasse/parameters/scene.h>
#include <crevasse/periodic/observed_periods.h>
#include <crevasse/periodic/periodic_choice.h>
#include <crevasse/periodic/periodic_method.h>
#include <crevasse/periodic/run_state.h>

#include <functional>
#include <optional>
#include <vector>

namespace Crevasse
{
  /** The search for the periodic state, by the method chosen. */
  template <int dim>
  class PeriodicSearch
  {
  public:
    /** All arguments must outlive this object.
     *
     * @param flow that was found; null: none was looked for.
     * @param direct what the direct method has found; null: it was not called
     * for, or has failed. */
    PeriodicSearch(const Scene           &scene,
                   const Body<dim>       &body,
                   const PeriodicChoice  &choice,
                   const SecularSplit    &split,
                   const SecularFlow     *flow,
                   const FourierResult   *direct,
                   const RelaxationTimes &relaxation_times,
                   Log                   &log);

    /**
     * Searches from the start, or from what was found directly; a march goes on
     * to the end of the leg.
     *
     * @param state The start; in the end its strain, and its displacement
     * unless the leg ends the run, are those after the last period.
     * @param evolution of q, if the choice needs a periodic strain.
     * @param period_map of the scene's steps and scheme, for that evolution.
     * @throw NumericalError if what was found directly is not a solution.
     */
    PeriodicResult
    run(Evolution<dim>                                  &evolution,
        PeriodMap<dim>                                  &period_map,
        StepList                                        &steps,
        const typename ObservedPeriods<dim>::SolveCount &n_solves,
        const std::vector<Observer *>                   &observers,
        RunState                                        &state,
        Leg                                             &leg) const;

  private:
    /** Shows the period that was found, and compares it with its states: not
     * converged if they differ and another method may take over. */
    PeriodicResult
    show(Evolution<dim>                                  &evolution,
         StepList                                        &steps,
         const typename ObservedPeriods<dim>::SolveCount &n_solves,
         const std::vector<Observer *>                   &observers,
         Pauses                                          *pauses) const;

    Ending
    march(ObservedPeriods<dim> &periods, Vector &r) const;

    /** Nothing if the viscous strain need not come back, or nobody asks. */
    std::optional<ReturnDefect<dim>>
    return_defect(const MaterialState<dim> &material,
                  const UnilateralBounds   &bounds) const;

    /** Anderson::Settings::slowness */
    double
    slowness() const;

    Ending
    accelerate(ObservedPeriods<dim> &periods, Vector &r) const;

    const Scene           &scene;
    const Body<dim>       &body;
    const PeriodicChoice  &choice;
    const SecularSplit    &split;
    const SecularFlow     *flow;
    const FourierResult   *direct;
    const RelaxationTimes &relaxation_times;
    Log                   &log;
  };
} // namespace Crevasse

#endif
