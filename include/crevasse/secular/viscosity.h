// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_secular_viscosity_h
#define crevasse_secular_viscosity_h

#include <crevasse/base/collectively.h>
#include <crevasse/material/voigt_matrix.h>
#include <crevasse/model/body.h>
#include <crevasse/time/state.h>

namespace Crevasse
{
  /** Viscosities of the branches of a material at the quadrature points,
   * without the factor η₀. */
  template <int dim>
  struct Viscosity
  {
    using Matrices = PointValues<VoigtMatrix<dim>>;

    /** Inverts fluidities. Collective. @throw NumericalError if one is
     * singular, so that a part of the strain does not flow. */
    Viscosity(const Body<dim> &body, const MaterialState<dim> &material)
      : branches(inverses(body, material))
      , sum(branches.front())
      , imposed_rate(body.points.n_local_points)
    {
      body.imposed.add_strains(body.imposed.rates, 1., imposed_rate);
      for (unsigned int i = 1; i < branches.size(); ++i)
        sum = add(sum, branches[i], body.points.n_local_points);
    }

    std::vector<Matrices> branches; ///< ηᵢ = Hᵢ⁻¹; plane stress: in plane
    Matrices              sum;      ///< sum Σ ηᵢ

    /** Imposed strain rates of the flow, by point. */
    std::vector<VoigtVector<dim>> imposed_rate;

    /** Sets the strain rates αᵢ = Hᵢ ηᵢ Dβ of a flow with known β: Dβ and the
     * creep in thickness direction. */
    void
    set_strain_rates(const Body<dim>          &body,
                     const MaterialState<dim> &material,
                     SecularFlow              &flow) const
    {
      using Field = QuadratureField<dim>;
      body.points.initialize(flow.strain_rate, branches.size());
      body.strain_operator.for_each_strain(
        flow.velocity,
        [&](const std::size_t offset, const VoigtVector<dim> &of_vector) {
          const std::size_t      point       = offset / Field::n_components;
          const VoigtVector<dim> strain_rate = of_vector + imposed_rate[point];
          for (unsigned int i = 0; i < branches.size(); ++i)
            Field::set(flow.strain_rate,
                       offset * branches.size() + i * Field::n_components,
                       (*material.fluidity[i])[point] *
                         (branches[i][point] * strain_rate));
        });
    }

  private:
    static std::vector<Matrices>
    inverses(const Body<dim> &body, const MaterialState<dim> &material)
    {
      std::vector<Matrices> all;
      collectively(body.space.communicator(), [&]() {
        for (const auto &fluidity : material.fluidity)
          all.push_back(transform(
            *fluidity, body.points.n_local_points, [&](const auto &H) {
              return inverse<dim>(material.plane_stress ? in_plane<dim>(H) : H);
            }));
      });
      return all;
    }
  };

  /** Whether all fluidities are invertible (in plane stress without thickness
   * direction, in which a plate creeps without stress). Collective. */
  template <int dim>
  bool
  has_viscosity(const Body<dim> &body)
  {
    constexpr double         definite = 1e-12;
    const MaterialState<dim> material = body.material.at(0.);
    bool                     has_all  = true;
    collectively(body.space.communicator(), [&]() {
      for (const auto &fluidity : material.fluidity)
        for (const VoigtMatrix<dim> &H : fluidity->distinct())
          has_all = has_all && least_relative_eigenvalue<dim>(
                                 material.plane_stress ? in_plane<dim>(H) : H,
                                 material.plane_stress) >= definite;
    });
    return dealii::Utilities::MPI::min(has_all ? 1 : 0,
                                       body.space.communicator()) == 1;
  }
} // namespace Crevasse

#endif
