// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/cell_values.h>
#include <crevasse/discretisation/strain_operator.h>
#include <crevasse/time/evolution.h>

#include <numeric>

namespace Crevasse
{
  template <int dim>
  Evolution<dim>::Evolution(const StrainOperator<dim>  &strain_operator,
                            const QuadratureField<dim> &points,
                            const ExternalLoads<dim>   &loads,
                            InstantProvider<dim>       &instants,
                            const double                newton_tolerance)
    : strain_operator(strain_operator)
    , loads(loads)
    , instants(instants)
    , creep_stage(strain_operator, loads, instants, newton_tolerance)
  {
    strain_operator.initialize(last.displacement);
    strain_operator.initialize(loading);
    points.initialize(last.stress);
  }



  template <int dim>
  void
  Evolution<dim>::solve(const double t, ContactSolver &solver, const double k)
  {
    solver.solve(
      loading, last.displacement, last.contact_forces, k, friction_at(t));
    last.stiffness_factor = k;
    last.instant          = t;
    note(solver);
  }



  template <int dim>
  void
  Evolution<dim>::solve_explicitly(const double        t,
                                   const Instant<dim> &instant,
                                   const Vector       &r)
  {
    using Field                         = QuadratureField<dim>;
    const MaterialState<dim>  &material = instant.material;
    const auto                &K        = *material.stiffness;
    const double               k        = material.stiffness_factor;
    const InelasticStrain<dim> inelastic(material, r, base);
    std::optional<Stopwatch>   watch(std::in_place, "strain sweeps");
    loads.evaluate(t, loading);
    if (r.size() > 0 && material.is_plain() && base == nullptr)
      strain_operator.add_transpose( //
        loading,
        [&r, kK = k * K[0]](const std::size_t offset) {
          return kK * Field::get(r, offset);
        });
    else if (r.size() > 0 || material.free_strain != nullptr)
      strain_operator.add_transpose(loading, [&](const std::size_t offset) {
        return k * (K[offset / Field::n_components] * inelastic(offset));
      });
    watch.reset();
    solve(t, instant.contact_solver, k);
  }



  template <int dim>
  void
  Evolution<dim>::rate(const double time, const Vector &r, Vector &rate)
  {
    const Stopwatch           watch("rate evaluations");
    const double              t        = instant_of(time);
    const Instant<dim>        instant  = instants.at(t);
    const MaterialState<dim> &material = instant.material;
    solve_explicitly(t, instant, r);
    ++evaluations;
    if (material.is_plain() && flow == nullptr && base == nullptr)
      return plain_rate(material, r, rate);
    const InelasticStrain<dim> inelastic(material, r, base);
    if (material.creep != nullptr)
      {
        set_stress(inelastic);
        fastest = creep_stage.rates(inelastic, 0., last.stress, rate);
        return;
      }
    stress_and_rates(
      inelastic,
      [&](const std::size_t       point,
          const unsigned int      i,
          const std::size_t       place,
          const VoigtVector<dim> &mechanical) {
        return material.fractions[i] *
               ((*material.stiffness)[point] *
                (mechanical - inelastic.viscous(place)));
      },
      rate);
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
    const Stopwatch watch("strain sweeps");
    strain_operator.for_each_strain( //
      last.displacement,
      [&](const std::size_t offset, const VoigtVector<dim> &strain) {
        const VoigtVector<dim> stress = K * (strain - Field::get(r, offset));
        Field::set(last.stress, offset, stress);
        Field::set(rate, offset, H * stress);
      });
  }



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
    const Stopwatch           watch("strain sweeps");
    strain_operator.for_each_strain(
      last.displacement,
      [&](const std::size_t offset, const VoigtVector<dim> &strain) {
        const std::size_t      point      = offset / Field::n_components;
        const VoigtVector<dim> mechanical = strain - inelastic.free(offset);
        VoigtVector<dim>       sum;
        if (material.spring != 0.)
          sum = material.spring * ((*material.stiffness)[point] * mechanical);
        for (unsigned int i = 0; i < inelastic.n_branches; ++i)
          {
            const std::size_t      place = inelastic.place(offset, i);
            const VoigtVector<dim> stress =
              branch_stress(point, i, place, mechanical);
            sum += stress;
            VoigtVector<dim> branch_rate =
              factor * ((*material.fluidity[i])[point] * stress);
            if (flow != nullptr)
              branch_rate -= Field::get(flow->strain_rate, place);
            Field::set(rate, place, branch_rate);
          }
        Field::set(last.stress, offset, k * sum);
      });
  }



  template <int dim>
  VoigtVector<dim>
  Evolution<dim>::known_strain(const InelasticStrain<dim> &known,
                               const std::size_t           place,
                               const double                c) const
  {
    VoigtVector<dim> strain = known.viscous(place);
    if (flow != nullptr)
      strain -= c * QuadratureField<dim>::get(flow->strain_rate, place);
    return strain;
  }



  template <int dim>
  void
  Evolution<dim>::implicit_rate(const double  time,
                                const Vector &known,
                                const double  c,
                                Vector       &rate)
  {
    const Stopwatch evaluation("rate evaluations");
    const double    t = instant_of(time);
    if (instants.material_at(t).creep != nullptr)
      {
        friction_at(t);
        note(creep_stage.solve(t, known, base, c, last, loading));
        creep_stage.rates({instants.material_at(t), known},
                          c,
                          last.stress,
                          rate);
        ++evaluations;
        return;
      }
    const ImplicitInstant<dim>    instant = instants.implicit_at(t, c);
    const AlgorithmicModuli<dim> &moduli  = instant.moduli;
    const double                  k       = instant.material.stiffness_factor;
    const InelasticStrain<dim>    inelastic(instant.material, known, base);

    std::optional<Stopwatch> watch(std::in_place, "strain sweeps");
    loads.evaluate(t, loading);
    strain_operator.add_transpose(loading, [&](const std::size_t offset) {
      const std::size_t point  = offset / inelastic.n;
      VoigtVector<dim>  stress = moduli.sum[point] * inelastic.free(offset);
      for (unsigned int i = 0; i < inelastic.n_branches; ++i)
        stress += moduli.branches[i][point] *
                  known_strain(inelastic, inelastic.place(offset, i), c);
      return k * stress;
    });
    watch.reset();
    solve(t, *instant.contact_solver, k);
    implicit_rates(instant, known, c, rate);
    ++evaluations;
  }



  template <int dim>
  void
  Evolution<dim>::set_stress(const InelasticStrain<dim> &inelastic)
  {
    using Field                        = QuadratureField<dim>;
    const MaterialState<dim> &material = inelastic.material;
    const Stopwatch           watch("strain sweeps");
    strain_operator.for_each_strain(
      last.displacement,
      [&](const std::size_t offset, const VoigtVector<dim> &strain) {
        Field::set(last.stress,
                   offset,
                   material.stiffness_factor *
                     ((*material.stiffness)[offset / Field::n_components] *
                      (strain - inelastic(offset))));
      });
  }



  template <int dim>
  void
  Evolution<dim>::semi_implicit_rate(const double  time,
                                     const Vector &predicted,
                                     const Vector &known,
                                     const double  c,
                                     Vector       &rate)
  {
    const Stopwatch watch("rate evaluations");
    const double    t = instant_of(time);
    solve_explicitly(t, instants.at(t), predicted);
    implicit_rates(instants.implicit_material_at(t, c), known, c, rate);
    ++evaluations;
  }



  template <int dim>
  void
  Evolution<dim>::implicit_rates(const ImplicitInstant<dim> &instant,
                                 const Vector               &known,
                                 const double                c,
                                 Vector                     &rate)
  {
    const InelasticStrain<dim> inelastic(instant.material, known, base);
    stress_and_rates(
      inelastic,
      [&](const std::size_t       point,
          const unsigned int      i,
          const std::size_t       place,
          const VoigtVector<dim> &mechanical) {
        return instant.moduli.branches[i][point] *
               (mechanical - known_strain(inelastic, place, c));
      },
      rate);
  }



  template <int dim>
  void
  Evolution<dim>::apply_relaxation(const unsigned int order,
                                   const double       t,
                                   const double       c,
                                   Vector            &values)
  {
    using Field          = QuadratureField<dim>;
    const auto &branches = instants.relaxation_at(instant_of(t), c).branches;
    const std::size_t n = Field::n_components, block = n * branches.size();
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
  void
  Evolution<dim>::elastic_state(const double t)
  {
    const Instant<dim> instant = instants.at(t);
    const Vector       none;
    solve_explicitly(t, instant, none);
    set_stress(InelasticStrain<dim>(instant.material, none));
  }



  template <int dim>
  void
  Evolution<dim>::set_scales(const Space<dim>          &space,
                             const std::vector<double> &all_instants)
  {
    using Field = QuadratureField<dim>;
    std::vector<double> shares(last.stress.locally_owned_size() /
                               Field::n_components);
    for_each_point(space,
                   dealii::update_JxW_values,
                   [&shares](const auto &values, const auto q, const auto p) {
                     shares[p] = values.JxW(q);
                   });
    const MPI_Comm communicator = space.communicator();
    const double   volume       = dealii::Utilities::MPI::sum(
      std::accumulate(shares.begin(), shares.end(), 0.), communicator);

    stress_scales.assign(shares.size(), 0.);
    double largest = 0.;
    for (const double t : all_instants)
      {
        elastic_state(t);
        const MaterialState<dim> &material = instants.at(t).material;
        fractions                          = material.fractions;
        double sum                         = 0.;
        for (std::size_t point = 0; point < shares.size(); ++point)
          {
            const double share = shares[point] / volume;
            stress_scales[point] =
              std::max(stress_scales[point],
                       std::sqrt(share) * material.stiffness_factor *
                         (*material.stiffness)[point].norm());
            sum += share * Field::get(last.stress, point * Field::n_components)
                             .norm_square();
          }
        largest =
          std::max(largest, dealii::Utilities::MPI::sum(sum, communicator));
      }
    elastic_stress = std::sqrt(largest);
    const MaterialState<dim> &material =
      instants.material_at(all_instants.front());
    if (material.hardens && elastic_stress > 0.) // r ~ strain^(1+m)
      for (std::size_t p = 0; p < shares.size(); ++p)
        stress_scales[p] /=
          std::pow(elastic_stress * std::sqrt(shares[p] / volume) /
                     stress_scales[p],
                   (*material.creep)[p].constants.back());
  }



  template <int dim>
  double
  Evolution<dim>::relaxation_rate() const
  {
    if (fastest < 0.)
      return 0.; // on all ranks
    return dealii::Utilities::MPI::max(fastest,
                                       last.stress.get_mpi_communicator());
  }



  template <int dim>
  void
  Evolution<dim>::strain_per_stress(const Vector &r, Vector &scale) const
  {
    constexpr unsigned int n = QuadratureField<dim>::n_components;
    scale.reinit(r, true);
    std::size_t entry = 0;
    for (const double stress : stress_scales)
      for (const double fraction : fractions)
        for (unsigned int c = 0; c < n; ++c)
          scale.local_element(entry++) = 1. / (fraction * stress);
  }



  template class Evolution<2>;
  template class Evolution<3>;
} // namespace Crevasse
