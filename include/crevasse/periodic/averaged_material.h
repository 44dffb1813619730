// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_averaged_material_h
#define crevasse_periodic_averaged_material_h

#include <crevasse/model/contact_system_cache.h>
#include <crevasse/periodic/stress_history.h>
#include <crevasse/time/stages.h>

namespace Crevasse
{
  /**
   * Material of a body averaged over a period by the quadrature of its stages:
   * fluidities H̄ᵢ = ∫ Hᵢ k/η₀ dt of the whole period, and the stiffness K̄, the
   * mean of K weighted by the flow. If creep is not linear, H is the
   * derivative of the creep rate by the stress of the last period.
   */
  template <int dim>
  class AveragedMaterial
  {
  public:
    /** Averages the material of the cache's instants. Collective.
     *
     * @param stresses of the last period at all stages, if creep is not linear.
     */
    AveragedMaterial(const Body<dim>         &body,
                     const Stages            &stages,
                     ContactSystemCache<dim> &instants,
                     const StressHistory     &stresses);

    /** Weights of each stage in the mean contact force on each bound: parts of
     * the flow, in the mean over the cells around, and at least 1e-9. The sum
     * over the stages is 1 but for that. Collective.
     *
     * @param bounded unknowns of the bounds on all ranks. */
    std::vector<dealii::Vector<double>>
    weights_on_lip(const Body<dim>             &body,
                   const DirectSolver::Indices &bounded) const;

    MaterialState<dim> state; ///< linear, with factors k and η₀ of 1

    /** Largest factor k of the stiffness at the stages. */
    double largest_factor = 0.;

  private:
    /** Part of the flow at each stage and local point. */
    std::vector<std::vector<double>> shares;
  };
} // namespace Crevasse

#endif
