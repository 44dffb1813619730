// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/state_archive.h>
#include <crevasse/time/evolution.h>
#include <crevasse/time/inelastic_strain.h>

#include <algorithm>

namespace Crevasse
{
  void
  State::serialize(StateArchive &archive)
  {
    archive.nodal(displacement);
    archive.at_points(stress);
    archive.on_bounds(contact_forces);
    archive.common(stiffness_factor);
  }



  template <int dim>
  Evolution<dim>::Evolution(const StrainOperator<dim>  &strain_operator,
                            const QuadratureField<dim> &points,
                            const ExternalLoads<dim>   &loads,
                            InstantProvider<dim>       &instants)
    : strain_operator(strain_operator)
    , loads(loads)
    , instants(instants)
  {
    strain_operator.initialize(last.displacement);
    strain_operator.initialize(loading);
    points.initialize(last.stress);
  }



  template <int dim>
  void
  Evolution<dim>::split_off(const SecularFlow &secular_flow)
  {
    flow = &secular_flow;
  }



  template <int dim>
  void
  Evolution<dim>::repeat(const StepList &steps)
  {
    period = &steps;
  }



  template <int dim>
  void
  Evolution<dim>::begin_step(const double t)
  {
    step_begin = t;
  }



  template <int dim>
  double
  Evolution<dim>::instant_of(const double t) const
  {
    if (period == nullptr)
      return t;
    return t > step_begin && period->jumps_at(t) ? period->just_before(t)
                                                 : period->within_period(t);
  }



  template <int dim>
  void
  Evolution<dim>::assemble_loading(const double                t,
                                   const MaterialState<dim>   &material,
                                   const InelasticStrain<dim> *inelastic_strain)
  {
    const double k = material.stiffness_factor;
    loads.evaluate(t, loading);
    if (inelastic_strain != nullptr)
      {
        const auto &K = *material.stiffness;
        if (material.is_plain())
          strain_operator.add_transpose(
            loading,
            [&r = inelastic_strain->r,
             kK = k * K[0]](const std::size_t offset) {
              return kK * QuadratureField<dim>::get(r, offset);
            });
        else
          strain_operator.add_transpose(loading, [&](const std::size_t offset) {
            return k * (K[offset / QuadratureField<dim>::n_components] *
                        (*inelastic_strain)(offset));
          });
      }
  }



  template <int dim>
  void
  Evolution<dim>::solve_for_displacement(ContactSolver &contact_solver,
                                         const double   k)
  {
    contact_solver.solve(loading, last.displacement, last.contact_forces, k);
    last.stiffness_factor = k;
    last_solver           = &contact_solver;
  }



  template <int dim>
  void
  Evolution<dim>::rate(const double time, const Vector &r, Vector &rate)
  {
    const double               t        = instant_of(time);
    const Instant<dim>         instant  = instants.at(t);
    const MaterialState<dim>  &material = instant.material;
    const InelasticStrain<dim> inelastic(material, r);
    assemble_loading(t, material, &inelastic);
    solve_for_displacement(instant.contact_solver, material.stiffness_factor);
    if (material.is_plain() && flow == nullptr)
      plain_rate(material, r, rate);
    else
      general_rate(inelastic, rate);
    ++rate_evaluations;
  }



  template <int dim>
  void
  Evolution<dim>::plain_rate(const MaterialState<dim> &material,
                             const Vector             &r,
                             Vector                   &rate)
  {
    using Field              = QuadratureField<dim>;
    const VoigtMatrix<dim> K = (*material.stiffness)[0] * //
                               material.stiffness_factor;
    const VoigtMatrix<dim> H = (*material.fluidity[0])[0] / //
                               material.viscosity_factor;
    strain_operator.for_each_strain(last.displacement,
                                    [&](const std::size_t       offset,
                                        const VoigtVector<dim> &strain) {
                                      const VoigtVector<dim> stress =
                                        K * (strain - Field::get(r, offset));
                                      Field::set(last.stress, offset, stress);
                                      Field::set(rate, offset, H * stress);
                                    });
  }



  template <int dim>
  void
  Evolution<dim>::elastic_state(const double t)
  {
    const Instant<dim>         instant  = instants.at(t);
    const MaterialState<dim>  &material = instant.material;
    const Vector               none;
    const InelasticStrain<dim> inelastic(material, none);
    const bool   has_thermal_strain = material.thermal_strain != nullptr;
    const auto  &K                  = *material.stiffness;
    const double k                  = material.stiffness_factor;
    assemble_loading(t, material, has_thermal_strain ? &inelastic : nullptr);
    solve_for_displacement(instant.contact_solver, k);
    strain_operator.for_each_strain(
      last.displacement,
      [&](const std::size_t offset, const VoigtVector<dim> &strain) {
        using Field = QuadratureField<dim>;
        Field::set(last.stress,
                   offset,
                   k * (K[offset / Field::n_components] *
                        (strain - inelastic.thermal(offset))));
      });
  }



  template <int dim>
  void
  Evolution<dim>::set_scales(const std::vector<double> &all_instants)
  {
    elastic_stress = 0.;
    stiffness_norms.assign(last.stress.locally_owned_size() /
                             QuadratureField<dim>::n_components,
                           0.);
    for (const double t : all_instants)
      {
        elastic_state(t);
        elastic_stress = std::max(elastic_stress, last.stress.linfty_norm());
        const MaterialState<dim> &material = instants.at(t).material;
        fractions                          = material.fractions;
        for (std::size_t point = 0; point < stiffness_norms.size(); ++point)
          stiffness_norms[point] =
            std::max(stiffness_norms[point],
                     material.stiffness_factor *
                       (*material.stiffness)[point].norm());
      }
  }



  template <int dim>
  void
  Evolution<dim>::strain_per_stress(const Vector &r, Vector &scale) const
  {
    constexpr unsigned int n = QuadratureField<dim>::n_components;
    scale.reinit(r, true);
    std::size_t entry = 0;
    for (const double stiffness : stiffness_norms)
      for (const double fraction : fractions)
        for (unsigned int c = 0; c < n; ++c)
          scale.local_element(entry++) = 1. / (fraction * stiffness);
  }



  template <int dim>
  void
  Evolution<dim>::switching_functions(std::vector<double> &values) const
  {
    last_solver->complementarity_functions(last.displacement,
                                           last.contact_forces,
                                           last.stiffness_factor,
                                           values);
  }



  template <int dim>
  void
  Evolution<dim>::serialize(StateArchive &archive)
  {
    archive.section("evolution");
    last.serialize(archive);
    archive.nodal(loading);
  }



  template class Evolution<2>;
  template class Evolution<3>;
} // namespace Crevasse
