// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/periodic/averaged_body.h>
#include <crevasse/secular/viscosity.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Material whose strain flows in all its parts: those that do not, get a
     * fluidity too small to matter. */
    template <int dim>
    MaterialState<dim>
    with_flow(MaterialState<dim> material, const std::size_t n_points)
    {
      // Relaxation within a period, and relative to that of the fastest part.
      constexpr double least = 1e-10, least_part = 1e-6;
      for (auto &fluidity : material.fluidity)
        fluidity =
          std::make_shared<const typename MaterialState<dim>::Matrices>(
            combine(*material.stiffness,
                    *fluidity,
                    n_points,
                    [&](const VoigtMatrix<dim> &K, const VoigtMatrix<dim> &H) {
                      return H + std::max(least, least_part * (K * H).norm()) *
                                   inverse<dim>(K);
                    }));
      return material;
    }



    /** Moduli of strains that do not flow. */
    template <int dim>
    PointValues<VoigtMatrix<dim>>
    moduli_without_flow(const MaterialState<dim> &material,
                        const unsigned int        i,
                        const std::size_t         n_points)
    {
      constexpr double many = 1e6, tiny = 1e-100;
      const double     w = material.fractions[i];
      return combine(*material.stiffness,
                     *material.fluidity[i],
                     n_points,
                     [&](const VoigtMatrix<dim> &K, const VoigtMatrix<dim> &H) {
                       const double periods =
                         many / std::max(tiny, w * (K * H).norm());
                       return w * relaxed_stiffness<dim>(K, H, w * periods);
                     });
    }
  } // namespace



  template <int dim>
  AveragedBody<dim>::AveragedBody(const Body<dim>         &body,
                                  const Stages            &stages,
                                  const UnilateralBounds  &bounds,
                                  ContactSystemCache<dim> &systems,
                                  const unsigned int       n_poles,
                                  const StressHistory     &stresses)
    : body(body)
    , bounds(bounds)
    , systems(systems)
    , settings(systems.settings)
    , stages(stages)
    , averaged(body, stages, systems, stresses)
    , spring(body.law.has_spring() ? averaged.state.spring : 0.)
  {
    // With this b the step of a single relaxation is wrong by 3 % at most.
    constexpr double          b     = 3.5;
    const MaterialState<dim> &state = averaged.state;
    const std::size_t         n     = body.points.n_local_points;
    for (const double fraction : state.fractions)
      {
        elastic.moduli.push_back(
          transform(*state.stiffness, n, [&](const VoigtMatrix<dim> &K) {
            return fraction * K;
          }));
        compliance.push_back(transform(elastic.moduli.back(), n, inverse<dim>));
      }
    elastic.system     = &systems.system_at(0.);
    const bool has_lip = elastic.system->problem().n_bounds() > 0;
    const bool condenses =
      settings.contact_choice.type == ContactSolverType::condensed_active_set;
    if (has_lip)
      settings.contact_choice.type = ContactSolverType::condensed_active_set;
    if (body.material.stiffness_varies || (has_lip && !condenses))
      assemble(*state.stiffness, elastic);
    if (n_poles > 0)
      prepare_flow();
    if (n_poles > 1)
      {
        AlgorithmicModuli<dim> moduli(state, 1. / b, n);
        assemble(moduli.sum, pole);
        pole.moduli = std::move(moduli.branches);
      }
    if (has_lip)
      prepare_lip();
  }



  template <int dim>
  void
  AveragedBody<dim>::prepare_flow()
  {
    const MaterialState<dim> &state = averaged.state;
    const std::size_t         n     = body.points.n_local_points;
    const bool                flows = has_viscosity(body);
    Viscosity<dim>            viscosity(
      body, flows && body.law.creep == nullptr ? state : with_flow(state, n));
    if (spring > 0.)
      flow.system = elastic.system;
    else
      assemble(viscosity.sum, flow);
    flow.moduli = std::move(viscosity.branches);
    if (!flows && spring == 0.)
      {
        rigid.moduli.push_back(moduli_without_flow(state, 0, n));
        auto sum = rigid.moduli.front();
        for (unsigned int i = 1; i < state.fluidity.size(); ++i)
          {
            rigid.moduli.push_back(moduli_without_flow(state, i, n));
            sum = add(sum, rigid.moduli.back(), n);
          }
        assemble(sum, rigid);
      }
  }



  template <int dim>
  AveragedBody<dim>::~AveragedBody()
  {
    for (const Part *part : {&elastic, &flow, &pole, &rigid})
      count(*part);
    for (const JumpPart &jump : jumps)
      count(jump.part);
  }



  template <int dim>
  void
  AveragedBody<dim>::count(const Part &part) const
  {
    if (part.own != nullptr)
      systems.add(part.own->statistics());
  }



  template <int dim>
  void
  AveragedBody<dim>::assemble(const Matrices &stiffness, Part &part)
  {
    const bool is_similar =
      settings.contact_choice.type == systems.settings.contact_choice.type;
    part.own =
      std::make_unique<ContactSystem<dim>>(settings,
                                           body.space,
                                           body.points,
                                           stiffness,
                                           bounds,
                                           is_similar ? &systems.system_at(0.)
                                                      : nullptr);
    part.system = part.own.get();
  }



  template <int dim>
  void
  AveragedBody<dim>::prepare_lip()
  {
    const auto &lip = elastic.system->problem().all_bounded_dofs();
    sign.reinit(lip.size());
    for (unsigned int k = 0; k < bounds.dofs.size(); ++k)
      sign(std::find(lip.begin(), lip.end(), bounds.dofs[k]) - lip.begin()) =
        bounds.sign[k];
    Utilities::MPI::sum(sign, body.space.communicator(), sign);
    shift.emplace(stiffness_along_normals(elastic),
                  averaged.weights_on_lip(body, lip));
  }



  template <int dim>
  LAPACKFullMatrix<double>
  AveragedBody<dim>::stiffness_along_normals(const Part &part) const
  {
    LAPACKFullMatrix<double> sigma(part.lip_stiffness());
    for (unsigned int i = 0; i < sign.size(); ++i)
      for (unsigned int j = 0; j < sign.size(); ++j)
        sigma(i, j) *= sign(i) * sign(j);
    return sigma;
  }



  template <int dim>
  const typename AveragedBody<dim>::JumpPart &
  AveragedBody<dim>::part_of_jump(const unsigned int n)
  {
    constexpr unsigned int most = 4; // factors in memory
    for (const JumpPart &known : jumps)
      if (known.n == n)
        return known;
    if (jumps.size() == most)
      {
        count(jumps.front().part);
        jumps.pop_front();
      }
    JumpPart &jump = jumps.emplace_back();
    jump.n         = n;
    AlgorithmicModuli<dim> moduli(averaged.state,
                                  n,
                                  body.points.n_local_points);
    assemble(moduli.sum, jump.part);
    jump.part.moduli = std::move(moduli.branches);
    if (shift)
      {
        jump.compliance = stiffness_along_normals(jump.part);
        jump.compliance.invert();
      }
    return jump;
  }



#define INSTANTIATE(dim)                                              \
  template AveragedBody<dim>::AveragedBody(const Body<dim> &,         \
                                           const Stages &,            \
                                           const UnilateralBounds &,  \
                                           ContactSystemCache<dim> &, \
                                           const unsigned int,        \
                                           const StressHistory &);    \
  template AveragedBody<dim>::~AveragedBody();                        \
  template const typename AveragedBody<dim>::JumpPart &               \
  AveragedBody<dim>::part_of_jump(const unsigned int)

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
