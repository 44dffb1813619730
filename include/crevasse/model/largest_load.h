// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_model_largest_load_h
#define crevasse_model_largest_load_h

#include <crevasse/model/body.h>
#include <crevasse/time/step_list.h>

namespace Crevasse
{
  /** The load vector at an instant of the period. */
  template <int dim>
  Vector
  loads_at(const Body<dim> &body, const double t);

  /** The begin of the step at which the load vector is largest. */
  template <int dim>
  double
  instant_of_largest_load(const Body<dim> &body, const StepList &steps);

  /** That instant and the begin of the step with the most opposite loads, if
   * there are opposite ones: a crack may be closed in the one and open in the
   * other. */
  template <int dim>
  std::vector<double>
  instants_of_extreme_loads(const Body<dim> &body, const StepList &steps);

  /** The largest force on a node over all steps and the stages between them;
   * for thermal strain, that which holds the body still.
   * @throw SceneError if it is too small or too large to compute with. */
  template <int dim>
  double
  largest_load(const Body<dim> &body, const StepList &steps);

  /** How far the load vector within a step is at most from the straight line
   * between its ends, relative to the largest of all: what steps that are too
   * few, or that meet a load at its zeros, do not see. */
  template <int dim>
  double
  load_missed_by_steps(const Body<dim> &body, const StepList &steps);

  /** A few instants whose elastic stress tells the size of all: those of the
   * largest load, and some others of the period. */
  template <int dim>
  std::vector<double>
  instants_of_scale(const Body<dim> &body, const StepList &steps);

  /** The ends of steps at which loads or material jump in time: the end of the
   * period, where t begins anew, and others if formulas can jump. Collective.
   *
   * @param largest_load over all steps, by largest_load(). */
  template <int dim>
  std::vector<double>
  find_jumps(const Scene     &scene,
             const Body<dim> &body,
             const StepList  &steps,
             const double     largest_load);

  /** The least change of temperature at four instants of the period and the
   * centres of cells. Collective. */
  template <int dim>
  double
  least_temperature(const Body<dim> &body, const double period);
} // namespace Crevasse

#endif
