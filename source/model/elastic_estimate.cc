// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/model/elastic_estimate.h>
#include <crevasse/time/evolution.h>

namespace Crevasse
{
  template <int dim>
  void
  look_at_elastic_states(const Body<dim>           &body,
                         ContactSystemCache<dim>   &systems,
                         const std::vector<double> &instants,
                         StressEstimator<dim>      &estimator)
  {
    Evolution<dim> evolution(body.strain_operator,
                             body.points,
                             body.loads,
                             systems);
    for (const double t : instants)
      {
        evolution.elastic_state(t);
        estimator.look_at(t,
                          evolution.state().stress,
                          evolution.state().contact_forces,
                          systems.at(t).material,
                          &evolution.state().displacement);
      }
  }



#define INSTANTIATE(dim)                                                 \
  template void look_at_elastic_states<dim>(const Body<dim> &,           \
                                            ContactSystemCache<dim> &,   \
                                            const std::vector<double> &, \
                                            StressEstimator<dim> &)

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
