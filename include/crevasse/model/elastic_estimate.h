// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_model_elastic_estimate_h
#define crevasse_model_elastic_estimate_h

#include <crevasse/discretisation/stress_estimator.h>
#include <crevasse/model/body.h>
#include <crevasse/model/contact_system_cache.h>

#include <vector>

namespace Crevasse
{
  /** Shows the estimator the elastic body with contact at these instants of
   * the period. Collective. @throw NumericalError */
  template <int dim>
  void
  look_at_elastic_states(const Body<dim>           &body,
                         ContactSystemCache<dim>   &systems,
                         const std::vector<double> &instants,
                         StressEstimator<dim>      &estimator);
} // namespace Crevasse

#endif
