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
    /** Computes values of the material for κ: AlgorithmicModuli or
     * RelaxationFunctions. */
    template <typename Values, int dim>
    std::shared_ptr<Values>
    make_values(const Body<dim>          &body,
                const MaterialState<dim> &material,
                const double              kappa)
    {
      std::shared_ptr<Values> values;
      collectively(body.space.communicator(), [&]() {
        values =
          std::make_shared<Values>(material, kappa, body.points.n_local_points);
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
               [this, &steps](const SparseMatrix &A) {
                 if (!sor_factor)
                   sor_factor = relaxation_factor(
                     A,
                     loads_at(this->body,
                              instant_of_largest_load(this->body, steps)));
                 return *sor_factor;
               },
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
              })
    , tangents(body,
               scene.loads.period,
               memory,
               {[this](const double t) -> decltype(auto) {
                  return material_at(t);
                },
                [this](const auto &moduli) { return make_system(moduli); }})
  {
  }



  template <int dim>
  std::shared_ptr<ContactSystem<dim>>
  ContactSystemCache<dim>::make_system(
    const typename MaterialState<dim>::Matrices &stiffness) const
  {
    auto system = std::make_shared<ContactSystem<dim>>(
      settings, body.space, body.points, stiffness, bounds, last.system.get());
    if (last.system != nullptr)
      system->contact_solver().start_from(
        last.system->contact_solver().closed_bounds());
    return system;
  }



  template <int dim>
  const MaterialState<dim> &
  ContactSystemCache<dim>::material_at(const double t)
  {
    const MaterialField<dim> &field = body.material;
    const bool varies = field.stiffness_varies || field.fluidity_varies ||
                        field.free_strain_varies();
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
    const auto make = [&]() { return make_system(*material_at(t).stiffness); };
    if (!body.material.stiffness_varies && only_system == nullptr)
      only_system = make();
    last = {{t, 0.},
            only_system != nullptr ? only_system : systems.at({t, 0.}, make)};
    return *last.system;
  }



  template <int dim>
  const AlgorithmicModuli<dim> &
  ContactSystemCache<dim>::moduli_of(const Key &key)
  {
    return *moduli.at(key, [&]() {
      return make_values<AlgorithmicModuli<dim>>(body,
                                                 material_at(key.first),
                                                 key.second);
    });
  }



  template <int dim>
  ImplicitInstant<dim>
  ContactSystemCache<dim>::implicit_material_at(const double t, const double c)
  {
    const AlgorithmicModuli<dim> &values =
      moduli_of(step_key(t, c, material_at(t)));
    return {material_at(t), values, nullptr}; // with the factors of t
  }



  template <int dim>
  const RelaxationFunctions<dim> &
  ContactSystemCache<dim>::relaxation_of(const Key                &key,
                                         const MaterialState<dim> &material)
  {
    return *relaxation.at(key, [&]() {
      return make_values<RelaxationFunctions<dim>>(body, material, key.second);
    });
  }



  template <int dim>
  const RelaxationFunctions<dim> &
  ContactSystemCache<dim>::relaxation_at(const double t, const double c)
  {
    const MaterialState<dim> &material = material_at(t);
    return relaxation_of(step_key(t, c, material), material);
  }



  template <int dim>
  ImplicitInstant<dim>
  ContactSystemCache<dim>::implicit_at(const double t, const double c)
  {
    ImplicitInstant<dim> instant = implicit_material_at(t, c);
    instant.contact_solver =
      &system_of(step_key(t, c, instant.material)).contact_solver();
    return instant;
  }



  template <int dim>
  Tangent<dim>
  ContactSystemCache<dim>::tangent_at(const double  t,
                                      const double  c,
                                      const Vector &stress,
                                      const Vector &known)
  {
    ++of_the_past.implicit_stages;
    const auto *kept = tangents.nearest(t);
    return use(t,
               kept != nullptr ? *kept : tangents.renew(t, c, stress, known));
  }



  template <int dim>
  Tangent<dim>
  ContactSystemCache<dim>::use(const double                            t,
                               const typename KeptTangents<dim>::Kept &kept)
  {
    last = {{t, tangent}, kept.system};
    return {&kept.moduli, &kept.system->contact_solver()};
  }



  template <int dim>
  ContactSystem<dim> &
  ContactSystemCache<dim>::system_of(const Key &key)
  {
    if (key.second == 0.)
      return system_at(key.first);
    if (key.second == tangent)
      use(key.first, *tangents.nearest(key.first));
    else
      last = {key, systems.at(key, [&]() {
                return make_system(moduli_of(key).sum);
              })};
    return *last.system;
  }



  template <int dim>
  void
  ContactSystemCache<dim>::serialize(StateArchive &archive)
  {
    archive.section("contact solvers");
    Key              key = last.key;
    std::vector<Key> keys, of_moduli, of_relaxation;
    if (!archive.is_loading())
      {
        keys          = systems.keys();
        of_moduli     = moduli.keys();
        of_relaxation = relaxation.keys();
      }
    archive.common(key);
    archive.common(keys);
    archive.common(of_moduli);
    archive.common(of_relaxation);
    // Equal steps differ by rounding, and share the values of the first of
    // them: a resumed run needs its length.
    for (const Key &kept : of_moduli)
      moduli_of(kept);
    for (const Key &kept : of_relaxation)
      relaxation_of(kept, material_at(kept.first));
    if (only_system != nullptr)
      only_system->contact_solver().serialize(archive);
    tangents.serialize(archive);
    for (const Key &kept : keys)
      system_of(kept).contact_solver().serialize(archive);
    system_of(key);
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
