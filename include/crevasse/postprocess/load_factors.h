// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_load_factors_h
#define crevasse_postprocess_load_factors_h

#include <crevasse/model/body.h>
#include <crevasse/time/integrator.h>
#include <crevasse/time/step_list.h>

namespace Crevasse
{
  /** F of loads F(t) p(x), relative to the largest ones. */
  struct LoadFactors
  {
    Vector              reference; ///< the loads at the step where they are so
    std::vector<double> at_steps;  ///< at the beginning of each step
    /** T F̄/τ, with the integral of F by the rule of the time integrator: what
     * the discrete solution gains is then exactly this times u_el. */
    double drift = 0.;
  };

  /**
   * @param integrator null without viscosity.
   * @param comparison [Output] Elastic comparison: open or closed.
   * @throw SceneError if there is no closed form to compare with: the lip has
   * a gap, the viscosity is not proportional to the stiffness, the loads are
   * not of this form, or F changes its sign where it must not.
   */
  template <int dim>
  LoadFactors
  load_factors(const Body<dim>  &body,
               const StepList   &steps,
               const Integrator *integrator,
               const ComparedLip comparison);
} // namespace Crevasse

#endif
