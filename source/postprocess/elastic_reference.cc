// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/model/elastic_displacement.h>
#include <crevasse/model/largest_load.h>
#include <crevasse/postprocess/elastic_reference.h>

#include <algorithm>
#include <sstream>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    [[noreturn]] void
    throw_error(const ComparedLip comparison, const std::string &reason)
    {
      throw SceneError("[Output] Elastic comparison = " + name_of(comparison) +
                       ": " + reason + " Set it to none.");
    }



    /** F(t) where loads(t) = F(t) × reference. */
    template <int dim>
    class LoadFactor
    {
    public:
      LoadFactor(const Body<dim>  &body,
                 const StepList   &steps,
                 const ComparedLip comparison)
        : body(body)
        , steps(steps)
        , comparison(comparison)
        , reference_time(instant_of_largest_load(body, steps))
        , reference(loads_at(body, reference_time))
        , norm(reference.l2_norm())
      {
      }



      double
      operator()(const double instant) const
      {
        if (norm == 0.)
          return 0.;
        const double t      = steps.within_period(instant);
        Vector       loads  = loads_at(body, t);
        const double factor = (loads * reference) / (norm * norm);
        loads.add(-factor, reference);
        if (loads.l2_norm() > 1e-12 * norm)
          {
            std::ostringstream reason;
            reason << "the loads at t = " << t
                   << " are not a multiple of those at t = " << reference_time
                   << "; the closed form holds for loads F(t) p(x) only.";
            throw_error(comparison, reason.str());
          }
        return factor;
      }

    private:
      const Body<dim>  &body;
      const StepList   &steps;
      const ComparedLip comparison;
      const double      reference_time;
      const Vector      reference;
      const double      norm;
    };



    template <int dim>
    void
    require_suitable_body(const Body<dim> &body, const ComparedLip comparison)
    {
      bool has_gap = false;
      for (const LipNode<dim> &node : body.lip.nodes())
        has_gap = has_gap || node.gap != 0.;
      if (Utilities::MPI::max(has_gap ? 1 : 0, body.space.communicator()) == 1)
        throw_error(
          comparison,
          "the closed forms hold for a lip without initial opening; here "
          "[Boundary] Gap is not 0.");
      if (body.material.stiffness_varies() ||
          body.material.has_thermal_strain())
        throw_error(
          comparison,
          "the closed forms hold for a constant stiffness and without "
          "thermal strain.");
      if (body.effects.viscosity.on && !body.law.uniform_relaxation_time())
        throw_error(
          comparison,
          "the closed forms hold for a viscosity in proportion to the "
          "stiffness ([Material] Viscosity = relaxation time), all "
          "constant, or none.");
    }



    /** A lip that stays closed needs loads of one sign, and so does any lip
     * without viscosity, which has no memory to stay open by. */
    template <int dim>
    void
    require_suitable_signs(const Body<dim>           &body,
                           const std::vector<double> &factors,
                           const ComparedLip          comparison)
    {
      const auto [least, most] =
        std::minmax_element(factors.begin(), factors.end());
      const double negligible = 1e-12 * std::max(-*least, *most);
      if (!body.effects.contact.on || *least >= -negligible ||
          *most <= negligible)
        return;
      if (comparison == ComparedLip::closed)
        throw_error(
          comparison,
          "the loads F(t) p(x) change their sign over the period, so that "
          "the lip does not stay closed.");
      if (!body.effects.viscosity.on)
        throw_error(
          comparison,
          "the loads F(t) p(x) change their sign over the period, and "
          "without viscosity the lip opens and closes with them.");
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

    const LoadFactor<dim> factor(body, steps, comparison);
    LoadFactors           factors{{}, 0.};
    for (unsigned int k = 0; k < steps.n_steps(); ++k)
      factors.at_steps.push_back(factor(steps.instant(k)));
    require_suitable_signs(body, factors.at_steps, comparison);

    if (integrator != nullptr)
      {
        const TimeQuadrature rule = integrator->quadrature();
        if (rule.weights.empty())
          throw_error(comparison,
                      "[Time integration] Scheme = " +
                        integrator->description() +
                        " weights the loads by how fast they relax.");
        for (unsigned int k = 0; k < steps.n_steps(); ++k)
          for (unsigned int s = 0; s < rule.nodes.size(); ++s)
            if (rule.weights[s] != 0.)
              factors.integral +=
                steps.step(k) * rule.weights[s] *
                factor(steps.instant(k) + rule.nodes[s] * steps.step(k));
      }
    return factors;
  }



  template <int dim>
  ElasticComparison::Reference
  elastic_reference(const Scene             &scene,
                    const Body<dim>         &body,
                    ContactSystemCache<dim> &systems,
                    const StepList          &steps,
                    const Integrator        *integrator)
  {
    const LoadFactors factors =
      load_factors(body, steps, integrator, scene.output.elastic_comparison);
    const Vector loads = loads_at(body, instant_of_largest_load(body, steps));

    ElasticComparison::Reference reference;
    reference.factor       = factors.at_steps;
    reference.drift_factor = 0.;
    if (integrator != nullptr)
      reference.drift_factor =
        factors.integral / *body.law.uniform_relaxation_time();
    reference.displacement =
      elastic_displacement(scene,
                           body,
                           systems,
                           loads,
                           scene.output.elastic_comparison ==
                             ComparedLip::closed);
    body.points.initialize(reference.stress);
    const MaterialState<dim> material = body.material.at(0.);
    body.strain_operator.for_each_strain(
      reference.displacement,
      [&](const std::size_t point, const VoigtVector<dim> &strain) {
        QuadratureField<dim>::set(
          reference.stress,
          point,
          (*material.stiffness)[point / n_stress_components<dim>] * strain);
      });
    return reference;
  }



  template LoadFactors
  load_factors<2>(const Body<2> &,
                  const StepList &,
                  const Integrator *,
                  const ComparedLip);
  template LoadFactors
  load_factors<3>(const Body<3> &,
                  const StepList &,
                  const Integrator *,
                  const ComparedLip);
  template ElasticComparison::Reference
  elastic_reference<2>(const Scene &,
                       const Body<2> &,
                       ContactSystemCache<2> &,
                       const StepList &,
                       const Integrator *);
  template ElasticComparison::Reference
  elastic_reference<3>(const Scene &,
                       const Body<3> &,
                       ContactSystemCache<3> &,
                       const StepList &,
                       const Integrator *);
} // namespace Crevasse
