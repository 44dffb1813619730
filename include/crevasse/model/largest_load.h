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

  /** Beginning of the step at which the load vector is largest. */
  template <int dim>
  double
  instant_of_largest_load(const Body<dim> &body, const StepList &steps);

  /** Instants of the largest load and of the most opposite load, if any: a
   * crack may be closed at the one and open at the other. */
  template <int dim>
  std::vector<double>
  instants_of_extreme_loads(const Body<dim> &body, const StepList &steps);

  /** Largest nodal force over all steps and the stages between them; for
   * thermal strain, the force that prevents all displacement.
   * @throw SceneError if it is too small or too large to compute with. */
  template <int dim>
  double
  largest_load(const Body<dim> &body, const StepList &steps);

  /** Largest deviation of the load vector within a step from the straight line
   * between its ends, relative to the largest load: loads that too few steps,
   * or steps that meet a load at its zeros, miss. */
  template <int dim>
  double
  load_missed_by_steps(const Body<dim> &body, const StepList &steps);

  /** A few instants whose elastic stress gives the scale of stress: those of
   * the largest load, and some others of the period. */
  template <int dim>
  std::vector<double>
  instants_of_scale(const Body<dim> &body, const StepList &steps);

  /** Ends of steps at which loads or material jump in time: the end of the
   * period, where t restarts, and others if formulas can jump. Collective.
   *
   * @param largest_load over all steps, by largest_load(). */
  template <int dim>
  std::vector<double>
  find_jumps(const Scene     &scene,
             const Body<dim> &body,
             const StepList  &steps,
             const double     largest_load);

  /** Least change of temperature at four instants of the period and the centres
   * of cells. Collective. */
  template <int dim>
  double
  least_temperature(const Body<dim> &body, const double period);
} // namespace Crevasse

#endif
