// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_model_elastic_displacement_h
#define crevasse_model_elastic_displacement_h

#include <crevasse/model/contact_system_cache.h>
#include <crevasse/time/state.h>

#include <functional>

namespace Crevasse
{
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

  /** Receives an elastic state at an instant of the period. */
  template <int dim>
  using ElasticStateFunction = std::function<
    void(const double, const State &, const MaterialState<dim> &)>;

  /** Calls f(t, state, material) for elastic states with contact, at these
   * instants of the period. Collective. @throw NumericalError */
  template <int dim>
  void
  look_at_elastic_states(const Body<dim>                 &body,
                         ContactSystemCache<dim>         &systems,
                         const std::vector<double>       &instants,
                         const ElasticStateFunction<dim> &f);
} // namespace Crevasse

#endif
