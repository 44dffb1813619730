// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_periodic_choice_h
#define crevasse_periodic_periodic_choice_h

#include <crevasse/model/body.h>
#include <crevasse/time/step_list.h>

namespace Crevasse
{
  /** Method by which a run finds its periodic state. */
  struct PeriodicChoice
  {
    PeriodicMethodType method              = PeriodicMethodType::march;
    bool               starts_from_fourier = false;
    /** Whether another method replaces a method that fails. */
    bool        may_fall_back = false;
    std::string why;
    /** Advice which method to try if this one fails; empty if the scene allows
     * no other. */
    std::string alternative;

    /** Whether harmonic balance is used. */
    bool
    uses_fourier() const
    {
      return starts_from_fourier || method == PeriodicMethodType::fourier;
    }

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

    /** Method and reason, one line for the log. */
    std::string
    describe() const
    {
      return name_of(method) +
             (starts_from_fourier ? ", started from fourier" : "") + " (" +
             why + ')';
    }
  };

  /**
   * Chooses the method that the scene asks for. "automatic" takes harmonic
   * balance if only the loads depend on time (as a mere start for schemes other
   * than the trapezoidal one); else Anderson acceleration. If r may flow in an
   * unknown way, it takes averaged steps where a march would need many periods
   * and creep is linear, else march. Collective.
   *
   * @param steps steps with their jumps set.
   * @param largest_relaxation_time if less than a tenth of the period, Anderson
   * acceleration needs no start.
   * @throw SceneError if the scene asks for a method that cannot solve it.
   */
  template <int dim>
  PeriodicChoice
  choose_periodic_method(const Scene     &scene,
                         const Body<dim> &body,
                         const StepList  &steps,
                         const double     largest_relaxation_time);
} // namespace Crevasse

#endif
