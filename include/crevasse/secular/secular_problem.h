// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_secular_secular_problem_h
#define crevasse_secular_secular_problem_h

#include <crevasse/model/contact_system_cache.h>
#include <crevasse/time/integrator.h>
#include <crevasse/time/state.h>

namespace Crevasse
{
  /** The split form u = βt + q: whether a scene is computed in it. */
  struct SecularSplit
  {
    Effects::Effect effect;           ///< effect; on: flow is solved for
    bool            is_split = false; ///< whether the run computes q, not u
    Vector          mean_load;        ///< f̄, if needed
    /** Whether the flow of the steps is known to rounding (in split form, for
     * the mean load of the steps), so that the viscous strain of a periodic
     * motion, except for the flow, is periodic. */
    bool        strain_returns = false;
    std::string warning; ///< warning for the log, or empty
  };

  /** Reason why no secular flow can be split off, or empty. Collective. */
  template <int dim>
  std::string
  secular_obstacle(const Body<dim> &body);

  /**
   * Chooses whether to split off a secular flow. Collective.
   * @param integrator null without viscosity.
   * @param needs_periodic_strain whether the method needs every flow split off.
   * @throw SceneError if [Periodic state] Secular split = on, but the material
   * has no secular flow that splits off, or the mean load of the steps differs
   * from that of the scene.
   */
  template <int dim>
  SecularSplit
  choose_secular_split(const Scene      &scene,
                       const Body<dim>  &body,
                       const StepList   &steps,
                       const Integrator *integrator,
                       const bool        needs_periodic_strain);

  /**
   * Solves the secular problem P3 (model, §2): β ∈ C₀ with
   *
   *     ∫ ε(v−β) : η ε(β) ≥ f̄ · (v−β)     for all v ∈ C₀,
   *
   * where f̄ is the mean of the loads divided by η₀, and C₀ the cone of a lip
   * without gap. The cost is added to the statistics of the solvers. */
  template <int dim>
  SecularFlow
  solve_secular_problem(const Body<dim>         &body,
                        const Vector            &mean_load,
                        ContactSystemCache<dim> &systems);
} // namespace Crevasse

#endif
