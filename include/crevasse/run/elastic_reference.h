// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#ifndef crevasse_run_elastic_reference_h
#define crevasse_run_elastic_reference_h

#include <crevasse/output/elastic_comparison.h>
#include <crevasse/run/body.h>
#include <crevasse/run/solvers.h>

namespace Crevasse
{
  /**
   * F at each step, for loads F(t) p(x), relative to the loads at
   * step_of_largest_load().
   *
   * @throw SceneError if the loads are not of this form: then there is no
   * closed form to compare with.
   */
  template <int dim>
  std::vector<double>
  load_factors(const Body<dim> &body, const StepList &steps);

  /** What ElasticComparison compares with: u_el and s_el at the instant of the
   * largest load, by the direct solver, and F at each step. */
  template <int dim>
  ElasticComparison::Reference
  elastic_reference(const Body<dim> &body,
                    Solvers<dim>    &solvers,
                    const StepList  &steps,
                    const bool       lip_closed);
} // namespace Crevasse

#endif
