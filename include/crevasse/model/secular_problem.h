// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_model_secular_problem_h
#define crevasse_model_secular_problem_h

#include <crevasse/model/contact_system_cache.h>
#include <crevasse/time/integrator.h>
#include <crevasse/time/secular_flow.h>

namespace Crevasse
{
  /** Whether a scene is computed in the split form, u = βt + q. */
  struct SecularSplit
  {
    Effects::Effect effect;           ///< on: there is a flow, found on its own
    bool            is_split = false; ///< whether q is computed, and not u
    Vector          mean_load;        ///< f̄, where it was needed
    /** Whether the flow is known by which the steps flow, to rounding (with the
     * split, that of the mean load as they see it): then the viscous strain of
     * a periodic motion comes back after a period, but for it. */
    bool        strain_returns = false;
    std::string warning; ///< empty: none
  };

  /** Why no secular flow can be split off; empty if it can. Collective. */
  template <int dim>
  std::string
  secular_obstacle(const Body<dim> &body);

  /**
   * @param integrator null without viscosity.
   * @param needs_periodic_strain whether the method splits the flow off in any
   * case where there is one.
   * @throw SceneError if [Periodic state] Secular split = on, but the material
   * has no secular flow that splits off, or the steps see another mean load
   * than there is.
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
   * without gap. What it costs is added to the statistics of the solvers. */
  template <int dim>
  SecularFlow
  solve_secular_problem(const Body<dim>         &body,
                        const Vector            &mean_load,
                        ContactSystemCache<dim> &systems);
} // namespace Crevasse

#endif
