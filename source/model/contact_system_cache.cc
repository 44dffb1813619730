// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/state_archive.h>
#include <crevasse/contact/sweep.h>
#include <crevasse/model/contact_system_cache.h>
#include <crevasse/model/largest_load.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Computes values of the material for a time c: AlgorithmicModuli or
     * RelaxationFunctions. */
    template <typename Values, int dim>
    std::shared_ptr<Values>
    make_values(const Body<dim>          &body,
                const MaterialState<dim> &material,
                const double              c)
    {
      std::shared_ptr<Values> values;
      collectively(body.space.communicator(), [&]() {
        values = std::make_shared<Values>(material,
                                          material.kappa(c),
                                          body.points.n_local_points);
      });
      return values;
    }
  } // namespace



  template <int dim>
  ContactSystemCache<dim>::ContactSystemCache(const Scene        &scene,
                                              const Body<dim>    &body,
                                              const SolverChoice &choice,
                                              const StepList     &steps,
                                              const double        largest_load,
                                              Log                &log)
    : settings{scene.contact,
               scene.linear_solver,
               choice.linear,
               choice.contact,
               {},
               largest_load}
    , scene(scene)
    , body(body)
    , log(log)
    , bounds(unilateral_bounds(body.lip, body.space, body.held_by_contact))
    , memory(body.space.communicator(),
             1024. * 1024. * scene.linear_solver.memory_for_instants,
             log)
    , materials(memory,
                {},
                [&body](const MaterialState<dim> &state) {
                  return body.material.memory_of_variation(state);
                })
    , moduli(memory)
    , relaxation(memory)
    , systems(memory,
              [this](const ContactSystem<dim> &system) {
                add(system.statistics());
                // A dropped system was requested last before the new one.
                requests.erase(requests.end() - 2);
              })
    , tangents(body,
               scene.loads.period,
               memory,
               {[this](const double t) -> decltype(auto) {
                  return material_at(t);
                },
                [this](const auto &moduli) { return make_system(moduli); }})
  {
    settings.relaxation_factor = [this, &steps](const SparseMatrix &A) {
      if (!sor_factor)
        sor_factor = relaxation_factor(
          A, loads_at(this->body, instant_of_largest_load(this->body, steps)));
      return *sor_factor;
    };
    if (!body.material.stiffness_varies)
      only_system = make_system(*body.material.at(0.).stiffness);
    log.line("  solver: " + system_at(0.).contact_solver().description());
  }



  template <int dim>
  std::shared_ptr<ContactSystem<dim>>
  ContactSystemCache<dim>::make_system(
    const typename MaterialState<dim>::Matrices &stiffness) const
  {
    auto system = std::make_shared<ContactSystem<dim>>(
      settings, body.space, body.points, stiffness, bounds, last_system.get());
    if (last_system != nullptr)
      system->contact_solver().start_from(
        last_system->contact_solver().closed_bounds());
    return system;
  }



  template <int dim>
  const MaterialState<dim> &
  ContactSystemCache<dim>::material_at(const double t)
  {
    const MaterialField<dim> &field = body.material;
    const bool varies = field.stiffness_varies || field.fluidity_varies ||
                        field.thermal_strain_varies;
    // A material that does not vary has its only state at t = 0.
    const auto state = materials.at({varies ? t : 0., 0.}, [&]() {
      return std::make_shared<MaterialState<dim>>(field.at(t));
    });
    field.set_factors(t, *state);
    return *state;
  }



  template <int dim>
  ContactSystem<dim> &
  ContactSystemCache<dim>::system_at(const double t)
  {
    last_request = {Request::of_stiffness, t, 0.};
    last_system =
      only_system != nullptr ? only_system : systems.at({t, 0.}, [&]() {
        auto system = make_system(*material_at(t).stiffness);
        requests.push_back(last_request);
        return system;
      });
    return *last_system;
  }



  template <int dim>
  ImplicitInstant<dim>
  ContactSystemCache<dim>::implicit_material_at(const double t, const double c)
  {
    const MaterialState<dim> &material = material_at(t);
    const auto values = moduli.at(step_key(t, c, material), [&]() {
      return make_values<AlgorithmicModuli<dim>>(body, material, c);
    });
    return {material, *values, nullptr};
  }



  template <int dim>
  const RelaxationFunctions<dim> &
  ContactSystemCache<dim>::relaxation_at(const double t, const double c)
  {
    const MaterialState<dim> &material = material_at(t);
    last_relaxation = relaxation.at(step_key(t, c, material), [&]() {
      return make_values<RelaxationFunctions<dim>>(body, material, c);
    });
    return *last_relaxation;
  }



  template <int dim>
  ImplicitInstant<dim>
  ContactSystemCache<dim>::implicit_at(const double t, const double c)
  {
    ImplicitInstant<dim> instant = implicit_material_at(t, c);
    last_request                 = {Request::of_implicit_stage, t, c};
    last_system = systems.at(step_key(t, c, instant.material), [&]() {
      auto system = make_system(instant.moduli.sum);
      requests.push_back(last_request);
      return system;
    });
    instant.contact_solver = &last_system->contact_solver();
    return instant;
  }



  template <int dim>
  Tangent<dim>
  ContactSystemCache<dim>::tangent_at(const double  t,
                                      const double  c,
                                      const Vector &stress)
  {
    ++of_the_past.implicit_stages;
    const auto *kept = tangents.nearest(t);
    return use(t, kept != nullptr ? *kept : tangents.renew(t, c, stress));
  }



  template <int dim>
  Tangent<dim>
  ContactSystemCache<dim>::use(const double                            t,
                               const typename KeptTangents<dim>::Kept &kept)
  {
    last_request = {Request::of_tangent, t, kept.c};
    last_system  = kept.system;
    return {&kept.moduli, &last_system->contact_solver()};
  }



  template <int dim>
  ContactSystem<dim> &
  ContactSystemCache<dim>::system_of(const Request &request)
  {
    if (request.kind == Request::of_stiffness)
      return system_at(request.t);
    if (request.kind == Request::of_implicit_stage)
      implicit_at(request.t, request.c);
    else
      use(request.t, *tangents.nearest(request.t));
    return *last_system;
  }



  template <int dim>
  void
  ContactSystemCache<dim>::serialize(StateArchive &archive)
  {
    archive.section("contact solvers");
    bool                 is_used = last_system != nullptr;
    Request              last    = last_request;
    std::vector<Request> kept;
    if (!archive.is_loading())
      kept = requests;
    archive.common(is_used);
    archive.common(last);
    archive.common_list(kept);
    if (only_system != nullptr)
      only_system->contact_solver().serialize(archive);
    tangents.serialize(archive);
    for (const Request &request : kept)
      system_of(request).contact_solver().serialize(archive);
    if (is_used)
      system_of(last);
  }



  template <int dim>
  double
  ContactSystemCache<dim>::relaxation_factor(const SparseMatrix &matrix,
                                             const Vector       &loads) const
  {
    if (const std::optional<double> factor = *scene.contact.relaxation_factor)
      return *factor;
    // The factor is a property of A: a body with only thermal strain or without
    // load has the same.
    Vector forces = loads;
    if (forces.linfty_norm() == 0.)
      {
        forces = 1.;
        body.space.constraints.set_zero(forces);
      }
    const double norm = forces.linfty_norm();

    log.line("  searching for the relaxation factor of projected SOR");
    // As in the paper, without constraints; eight digits show the asymptotic
    // contraction.
    const Stopwatch        phase("relaxation factor");
    const UnilateralBounds none;
    const SignoriniProblem unconstrained(matrix, none);
    return Sweep(unconstrained)
      .best_factor(forces, 1e-8 * norm, scene.contact.maximum_iterations);
  }



  template <int dim>
  SolverStatistics
  ContactSystemCache<dim>::statistics() const
  {
    SolverStatistics all = of_the_past;
    all.add(tangents.statistics());
    if (only_system != nullptr)
      all.add(only_system->statistics());
    systems.for_each([&all](const ContactSystem<dim> &system) {
      all.add(system.statistics());
    });
    return all;
  }



  template class ContactSystemCache<2>;
  template class ContactSystemCache<3>;
} // namespace Crevasse
