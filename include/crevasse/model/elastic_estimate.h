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

#ifndef crevasse_model_elastic_estimate_h
#define crevasse_model_elastic_estimate_h

#include <crevasse/discretisation/stress_estimator.h>
#include <crevasse/model/body.h>
#include <crevasse/model/solvers.h>

#include <vector>

namespace Crevasse
{
  /** Shows the estimator the elastic body with contact at these instants of
   * the period. Collective. @throw NumericalError */
  template <int dim>
  void
  look_at_elastic_states(const Body<dim>           &body,
                         Solvers<dim>              &solvers,
                         const std::vector<double> &instants,
                         StressEstimator<dim>      &estimator);
} // namespace Crevasse

#endif
