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

#include <crevasse/run/elastic_reference.h>
#include <crevasse/scene/problems.h>

#include <sstream>

namespace Crevasse
{
  template <int dim>
  std::vector<double>
  load_factors(const Body<dim> &body, const StepList &steps)
  {
    const unsigned int k_ref     = step_of_largest_load(body, steps);
    const Vector       loads_ref = loads_at(body, steps.instant(k_ref));
    const double       norm_ref  = loads_ref.l2_norm();

    std::vector<double> factors;
    for (unsigned int k = 0; k < steps.n_steps(); ++k)
      {
        Vector       loads = loads_at(body, steps.instant(k));
        const double factor =
          norm_ref > 0. ? (loads * loads_ref) / (norm_ref * norm_ref) : 0.;
        factors.push_back(factor);
        loads.add(-factor, loads_ref);
        if (loads.l2_norm() > 1e-12 * norm_ref)
          {
            std::ostringstream message;
            message << "[Output] Elastic comparison: the loads at t = "
                    << steps.instant(k)
                    << " are not a multiple of those at t = "
                    << steps.instant(k_ref)
                    << "; the closed form holds for loads F(t) p(x) only. Set "
                       "it to none.";
            throw SceneError(message.str());
          }
      }
    for (const LipNode<dim> &node : body.lip.nodes())
      if (node.gap != 0.)
        throw SceneError(
          "[Output] Elastic comparison: the closed forms hold "
          "for a lip without initial opening; set it to none, "
          "or [Boundary] Gap to 0.");
    return factors;
  }



  template <int dim>
  ElasticComparison::Reference
  elastic_reference(const Body<dim> &body,
                    Solvers<dim>    &solvers,
                    const StepList  &steps,
                    const bool       lip_closed)
  {
    const Vector loads =
      loads_at(body, steps.instant(step_of_largest_load(body, steps)));

    ElasticComparison::Reference reference;
    reference.relaxation_time = body.law.uniform_relaxation_time();
    reference.factor          = load_factors(body, steps);
    reference.displacement    = solvers.elastic_displacement(loads, lip_closed);
    body.points.initialize(reference.stress);
    body.strain_operator.for_each_strain(
      reference.displacement,
      [&](const std::size_t point, const VoigtVector<dim> &strain) {
        QuadratureField<dim>::set(reference.stress,
                                  point,
                                  body.law.stiffness() * strain);
      });
    return reference;
  }



  template std::vector<double>
  load_factors<2>(const Body<2> &, const StepList &);
  template ElasticComparison::Reference
  elastic_reference<2>(const Body<2> &,
                       Solvers<2> &,
                       const StepList &,
                       const bool);
} // namespace Crevasse
