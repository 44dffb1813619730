// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_periodic_choice_h
#define crevasse_periodic_periodic_choice_h

#include <crevasse/model/body.h>
#include <crevasse/model/linear_choice.h>
#include <crevasse/time/step_list.h>

namespace Crevasse
{
  struct PeriodicResult;

  /** Method by which a run finds its periodic state. */
  struct PeriodicChoice
  {
    PeriodicMethodType method = PeriodicMethodType::march;
    /** Whether another method replaces a method that fails. */
    bool        may_fall_back = false;
    std::string why;
    /** Advice which method to try if this one fails; empty if the scene allows
     * no other. */
    std::string alternative;

    /** Whether the viscous strain must be periodic, without secular flow. */
    bool
    needs_periodic_strain() const
    {
      return method != PeriodicMethodType::march &&
             method != PeriodicMethodType::averaged;
    }

    /** Whether earlier periods are iterates of the search, not motions. */
    bool
    periods_are_iterates() const
    {
      return method == PeriodicMethodType::anderson ||
             method == PeriodicMethodType::averaged;
    }

    /** Message for a search that ended without its aim: its state, and advice.
     */
    std::string
    message_of_failure(const PeriodicStateParameters &parameters,
                       const PeriodicResult          &result) const;

    /** Method and reason, one line for the log. */
    std::string
    describe() const
    {
      return name_of(method) + " (" + why + ')';
    }
  };

  /**
   * Chooses the method that the scene asks for. "automatic" takes harmonic
   * balance if only the loads depend on time and the scheme is its trapezoidal
   * rule; Anderson acceleration, or a march where r may flow in an unknown way,
   * if stress is forgotten within a period; else averaged steps if they are
   * possible. Collective.
   *
   * @param steps steps with their jumps set.
   * @param linear solver of the body: averaged steps of a lip need a direct
   * one.
   * @param largest_relaxation_time of linear creep in the body.
   * @throw SceneError if the scene asks for a method that cannot solve it.
   */
  template <int dim>
  PeriodicChoice
  choose_periodic_method(const Scene              &scene,
                         const Body<dim>          &body,
                         const StepList           &steps,
                         const LinearSolverChoice &linear,
                         const double              largest_relaxation_time);
} // namespace Crevasse

#endif
