// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_elastic_reference_h
#define crevasse_postprocess_elastic_reference_h

#include <crevasse/model/body.h>
#include <crevasse/model/contact_system_cache.h>
#include <crevasse/postprocess/elastic_comparison.h>
#include <crevasse/time/integrator.h>

#include <string>
#include <vector>

namespace Crevasse
{
  /** F, for loads F(t) p(x), relative to the loads at
   * instant_of_largest_load().
   */
  struct LoadFactors
  {
    std::vector<double> at_steps; ///< at the beginning of each step
    double              integral; ///< over a period, by the integrator's rule
  };

  /**
   * @param integrator None without viscosity; the integral is then 0.
   * @param comparison [Output] Elastic comparison: open or closed.
   *
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

  /** What ElasticComparison compares with: u_el and s_el at the instant of the
   * largest load, by the direct solver, and F. */
  template <int dim>
  ElasticComparison::Reference
  elastic_reference(const Scene             &scene,
                    const Body<dim>         &body,
                    ContactSystemCache<dim> &systems,
                    const StepList          &steps,
                    const Integrator        *integrator);
} // namespace Crevasse

#endif
