// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_load_factors_h
#define crevasse_postprocess_load_factors_h

#include <crevasse/model/body.h>
#include <crevasse/time/integrator.h>
#include <crevasse/time/step_list.h>

namespace Crevasse
{
  /** Factors F of loads F(t) p(x), relative to the largest. */
  struct LoadFactors
  {
    Vector              reference; ///< the largest loads
    std::vector<double> at_steps;  ///< F at the beginning of each step
    /** T F̄/τ by the rule of the time integrator: discrete drift over u_el. */
    double drift = 0.;
  };

  /**
   * Computes the factors for a comparison with the elastic closed form.
   * @param integrator null without viscosity.
   * @param comparison [Output] Elastic comparison: open or closed.
   * @throw SceneError if there is no closed form: the lip has a gap, viscosity
   * is not proportional to stiffness, loads are not F(t) p(x), or F changes
   * sign where it must not.
   */
  template <int dim>
  LoadFactors
  load_factors(const Body<dim>  &body,
               const StepList   &steps,
               const Integrator *integrator,
               const ComparedLip comparison);
} // namespace Crevasse

#endif
