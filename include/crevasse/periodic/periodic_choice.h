// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_periodic_choice_h
#define crevasse_periodic_periodic_choice_h

#include <crevasse/model/body.h>
#include <crevasse/time/step_list.h>

namespace Crevasse
{
  /** By what a run finds its periodic state. */
  struct PeriodicChoice
  {
    PeriodicMethodType method              = PeriodicMethodType::march;
    bool               starts_from_fourier = false;
    /** Whether another method takes over where one fails. */
    bool        may_fall_back = false;
    std::string why;
    /** The method to try where this one fails, in words; empty: there is none
     * that this scene allows. */
    std::string alternative;

    /** Whether harmonic balance is used. */
    bool
    uses_fourier() const
    {
      return starts_from_fourier || method == PeriodicMethodType::fourier;
    }

    /** Whether r must be periodic, and so a secular flow split off. */
    bool
    needs_periodic_strain() const
    {
      return method != PeriodicMethodType::march;
    }

    /** Whether only the last period is one of the body. */
    bool
    periods_are_iterates() const
    {
      return method == PeriodicMethodType::anderson;
    }

    /** One line for the log. */
    std::string
    describe() const
    {
      return name_of(method) +
             (starts_from_fourier ? ", started from fourier" : "") + " (" +
             why + ')';
    }
  };

  /**
   * What the scene asks for; "automatic" takes harmonic balance where nothing
   * but the loads depends on time, as a start for schemes other than its own,
   * and else Anderson's acceleration, unless r may flow in an unknown way.
   * Collective.
   *
   * @param steps whose jumps are marked.
   * @param largest_relaxation_time Stress that is forgotten within a period
   * needs no start.
   * @throw SceneError if the scene asks for a method that cannot do it.
   */
  template <int dim>
  PeriodicChoice
  choose_periodic_method(const Scene     &scene,
                         const Body<dim> &body,
                         const StepList  &steps,
                         const double     largest_relaxation_time);
} // namespace Crevasse

#endif
