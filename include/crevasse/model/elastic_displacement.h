// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_model_elastic_displacement_h
#define crevasse_model_elastic_displacement_h

#include <crevasse/model/contact_system_cache.h>

namespace Crevasse
{
  template <int dim>
  class StressEstimator;

  /** Elastic displacement of a body of constant stiffness under the given
   * loads, with the lip open or held at u_N = 0. The cost is added to the
   * statistics of the solvers. */
  template <int dim>
  Vector
  elastic_displacement(const Scene             &scene,
                       const Body<dim>         &body,
                       ContactSystemCache<dim> &systems,
                       const Vector            &loads,
                       const bool               lip_closed);

  /** Passes elastic states with contact, at these instants of the period, to
   * the estimator. Collective. @throw NumericalError */
  template <int dim>
  void
  look_at_elastic_states(const Body<dim>           &body,
                         ContactSystemCache<dim>   &systems,
                         const std::vector<double> &instants,
                         StressEstimator<dim>      &estimator);
} // namespace Crevasse

#endif
