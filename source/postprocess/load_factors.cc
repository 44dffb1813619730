// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/model/largest_load.h>
#include <crevasse/postprocess/load_factors.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    void
    demand(const bool         fulfilled,
           const ComparedLip  comparison,
           const std::string &reason)
    {
      if (!fulfilled)
        throw SceneError(
          "[Output] Elastic comparison = " + name_of(comparison) + ": " +
          reason + " Set it to none.");
    }



    template <int dim>
    void
    require_suitable_body(const Body<dim> &body, const ComparedLip comparison)
    {
      demand(!body.lip.has_gap,
             comparison,
             "the closed forms hold for a lip without initial opening; here "
             "[Boundary] Gap is not 0.");
      demand(!body.friction,
             comparison,
             "the closed forms hold for lips without friction.");
      demand(!body.material.stiffness_varies &&
               !body.material.has_free_strain(),
             comparison,
             "the closed forms hold for a constant stiffness, without thermal "
             "strain and imposed displacement.");
      demand(!body.effects.viscosity.on || body.law.uniform_relaxation_time,
             comparison,
             "the closed forms hold for a viscosity in proportion to the "
             "stiffness ([Material] Viscosity = relaxation time), all "
             "constant, or none.");
    }



    /** Checks the sign of factors, which must not change if the lip stays
     * closed, nor without viscosity, whose memory can keep the lip open. */
    template <int dim>
    void
    require_suitable_signs(const Body<dim>           &body,
                           const std::vector<double> &factors,
                           const ComparedLip          comparison)
    {
      const auto [least, most] =
        std::minmax_element(factors.begin(), factors.end());
      const double negligible = 1e-12 * std::max(-*least, *most);
      const bool one_sign = !body.effects.contact.on || *least >= -negligible ||
                            *most <= negligible;
      const std::string reason =
        "the loads F(t) p(x) change their sign over the period, ";
      demand(one_sign || comparison != ComparedLip::closed,
             comparison,
             reason + "so that the lip does not stay closed.");
      demand(one_sign || body.effects.viscosity.on,
             comparison,
             reason +
               "and without viscosity the lip opens and closes with them.");
    }
  } // namespace



  template <int dim>
  LoadFactors
  load_factors(const Body<dim>  &body,
               const StepList   &steps,
               const Integrator *integrator,
               const ComparedLip comparison)
  {
    require_suitable_body(body, comparison);
    const double time   = instant_of_largest_load(body, steps);
    LoadFactors  result = {loads_at(body, time), {}, 0.};
    const double norm   = result.reference.l2_norm();
    const auto   factor = [&](const double instant) {
      if (norm == 0.)
        return 0.;
      const double t     = steps.within_period(instant);
      Vector       loads = loads_at(body, t);
      const double value = (loads * result.reference) / (norm * norm);
      loads.add(-value, result.reference);
      demand(loads.l2_norm() <= 1e-12 * norm,
             comparison,
             Text::Message()
               << "the loads at t = " << t
               << " are not a multiple of those at t = " << time
               << "; the closed form holds for loads F(t) p(x) only.");
      return value;
    };
    for (unsigned int k = 0; k < steps.n_steps(); ++k)
      result.at_steps.push_back(factor(steps.instant(k)));
    require_suitable_signs(body, result.at_steps, comparison);
    if (integrator == nullptr)
      return result;

    const TimeQuadrature &rule = integrator->properties.quadrature;
    demand(!rule.weights.empty(),
           comparison,
           "[Time integration] Scheme = " + integrator->properties.name +
             " has weights that depend on the relaxation time.");
    double integral = 0.;
    for (unsigned int k = 0; k < steps.n_steps(); ++k)
      for (unsigned int s = 0; s < rule.nodes.size(); ++s)
        if (rule.weights[s] != 0.)
          integral += steps.step(k) * rule.weights[s] *
                      factor(steps.instant(k) + rule.nodes[s] * steps.step(k));
    result.drift = integral / *body.law.uniform_relaxation_time;
    return result;
  }



  template decltype(load_factors<2>) load_factors<2>;
  template decltype(load_factors<3>) load_factors<3>;
} // namespace Crevasse
