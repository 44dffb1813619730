// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/time/evolution.h>
#include <crevasse/time/inelastic_strain.h>

namespace Crevasse
{
  template <int dim>
  template <typename BranchStress>
  void
  Evolution<dim>::stress_and_rates(const InelasticStrain<dim> &inelastic,
                                   const BranchStress         &branch_stress,
                                   Vector                     &rate)
  {
    using Field                        = QuadratureField<dim>;
    const MaterialState<dim> &material = inelastic.material;
    const double              k        = material.stiffness_factor;
    const double              factor   = k / material.viscosity_factor;
    strain_operator.for_each_strain(
      last.displacement,
      [&](const std::size_t offset, const VoigtVector<dim> &strain) {
        const std::size_t      point      = offset / Field::n_components;
        const VoigtVector<dim> mechanical = strain - inelastic.thermal(offset);
        VoigtVector<dim>       sum;
        if (material.spring != 0.)
          sum = material.spring * ((*material.stiffness)[point] * mechanical);
        for (unsigned int i = 0; i < inelastic.n_branches; ++i)
          {
            const VoigtVector<dim> stress =
              branch_stress(offset, i, mechanical);
            sum += stress;
            const std::size_t place = inelastic.offset_of_branch(offset, i);
            VoigtVector<dim>  branch_rate =
              factor * ((*material.fluidity[i])[point] * stress);
            if (flow != nullptr)
              branch_rate -= Field::get(flow->strain_rate, place);
            Field::set(rate, place, branch_rate);
          }
        Field::set(last.stress, offset, k * sum);
      });
  }



  template <int dim>
  void
  Evolution<dim>::general_rate(const InelasticStrain<dim> &inelastic,
                               Vector                     &rate)
  {
    using Field                        = QuadratureField<dim>;
    const MaterialState<dim> &material = inelastic.material;
    stress_and_rates(
      inelastic,
      [&](const std::size_t       offset,
          const unsigned int      i,
          const VoigtVector<dim> &mechanical) {
        const std::size_t place = inelastic.offset_of_branch(offset, i);
        return material.fractions[i] *
               ((*material.stiffness)[offset / Field::n_components] *
                (mechanical - Field::get(inelastic.r, place)));
      },
      rate);
  }



  template <int dim>
  void
  Evolution<dim>::implicit_rate(const double  time,
                                const Vector &known,
                                const double  c,
                                Vector       &rate)
  {
    using Field                           = QuadratureField<dim>;
    const double                  t       = instant_of(time);
    const ImplicitInstant<dim>    instant = instants.implicit_at(t, c);
    const AlgorithmicModuli<dim> &moduli  = instant.moduli;
    const double                  k       = instant.material.stiffness_factor;
    const InelasticStrain<dim>    inelastic(instant.material, known);

    loads.evaluate(t, loading);
    strain_operator.add_transpose(loading, [&](const std::size_t offset) {
      const std::size_t point  = offset / Field::n_components;
      VoigtVector<dim>  stress = moduli.sum[point] * inelastic.thermal(offset);
      for (unsigned int i = 0; i < inelastic.n_branches; ++i)
        stress +=
          moduli.branches[i][point] * known_strain(inelastic, offset, i, c);
      return k * stress;
    });
    solve_for_displacement(*instant.contact_solver, k);
    implicit_rates(instant, known, c, rate);
    ++rate_evaluations;
  }



  template <int dim>
  void
  Evolution<dim>::semi_implicit_rate(const double  time,
                                     const Vector &predicted,
                                     const Vector &known,
                                     const double  c,
                                     Vector       &rate)
  {
    const double t = instant_of(time);
    {
      const Instant<dim>         instant = instants.at(t);
      const InelasticStrain<dim> inelastic(instant.material, predicted);
      assemble_loading(t, instant.material, &inelastic);
      solve_for_displacement(instant.contact_solver,
                             instant.material.stiffness_factor);
    }
    implicit_rates(instants.implicit_material_at(t, c), known, c, rate);
    ++rate_evaluations;
  }



  template <int dim>
  void
  Evolution<dim>::apply_relaxation(const unsigned int order,
                                   const double       t,
                                   const double       c,
                                   Vector            &values)
  {
    using Field             = QuadratureField<dim>;
    const auto &branches    = instants.relaxation_at(instant_of(t), c).branches;
    const std::size_t n     = Field::n_components;
    const std::size_t block = n * branches.size();
    for (std::size_t place = 0; place < values.locally_owned_size(); place += n)
      {
        const PhiFunctions<dim> &phi =
          branches[place % block / n][place / block];
        Field::set(values,
                   place,
                   (order == 1 ? phi.first : phi.second) *
                     Field::get(values, place));
      }
  }



  template <int dim>
  VoigtVector<dim>
  Evolution<dim>::known_strain(const InelasticStrain<dim> &known,
                               const std::size_t           offset,
                               const unsigned int          branch,
                               const double                c) const
  {
    const std::size_t place  = known.offset_of_branch(offset, branch);
    VoigtVector<dim>  strain = QuadratureField<dim>::get(known.r, place);
    if (flow != nullptr)
      strain -= c * QuadratureField<dim>::get(flow->strain_rate, place);
    return strain;
  }



  template <int dim>
  void
  Evolution<dim>::implicit_rates(const ImplicitInstant<dim> &instant,
                                 const Vector               &known,
                                 const double                c,
                                 Vector                     &rate)
  {
    const AlgorithmicModuli<dim> &moduli = instant.moduli;
    const InelasticStrain<dim>    inelastic(instant.material, known);
    stress_and_rates(
      inelastic,
      [&](const std::size_t       offset,
          const unsigned int      i,
          const VoigtVector<dim> &mechanical) {
        return moduli.branches[i][offset / QuadratureField<dim>::n_components] *
               (mechanical - known_strain(inelastic, offset, i, c));
      },
      rate);
  }



#define INSTANTIATE(dim)                                                   \
  template void Evolution<dim>::general_rate(const InelasticStrain<dim> &, \
                                             Vector &);                    \
  template void Evolution<dim>::implicit_rate(const double,                \
                                              const Vector &,              \
                                              const double,                \
                                              Vector &);                   \
  template void Evolution<dim>::semi_implicit_rate(                        \
    const double, const Vector &, const Vector &, const double, Vector &); \
  template void Evolution<dim>::apply_relaxation(const unsigned int,       \
                                                 const double,             \
                                                 const double,             \
                                                 Vector &)

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
