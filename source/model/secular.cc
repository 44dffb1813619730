// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/material/voigt_matrix.h>
#include <crevasse/model/body.h>
#include <crevasse/model/secular.h>
#include <crevasse/time/secular_flow.h>

namespace Crevasse
{
  namespace
  {
    /** H as the inverse of a viscosity knows it: without the thickness, in
     * which a plate creeps but bears no stress, where K has none. */
    template <int dim>
    VoigtMatrix<dim>
    bearing_part(const VoigtMatrix<dim> &H, const bool plane_stress)
    {
      return plane_stress ? in_plane<dim>(H) : H;
    }
  } // namespace



  template <int dim>
  bool
  has_viscosity(const MaterialState<dim> &material)
  {
    constexpr double definite = 1e-12;
    for (const auto &fluidity : material.fluidity)
      for (const VoigtMatrix<dim> &H : fluidity->distinct())
        if (least_relative_eigenvalue<dim>(
              bearing_part<dim>(H, material.plane_stress),
              material.plane_stress) < definite)
          return false;
    return true;
  }



  template <int dim>
  Viscosity<dim>
  viscosity_of(const MaterialState<dim> &material, const std::size_t n_points)
  {
    std::vector<PointValues<VoigtMatrix<dim>>> branches;
    for (const auto &fluidity : material.fluidity)
      branches.push_back(
        transform(*fluidity, n_points, [&](const VoigtMatrix<dim> &H) {
          return inverse<dim>(bearing_part<dim>(H, material.plane_stress));
        }));
    PointValues<VoigtMatrix<dim>> sum = branches.front();
    for (unsigned int i = 1; i < branches.size(); ++i)
      sum = combine(sum,
                    branches[i],
                    n_points,
                    [](const VoigtMatrix<dim> &a, const VoigtMatrix<dim> &b) {
                      return a + b;
                    });
    return {std::move(branches), std::move(sum)};
  }



  template <int dim>
  void
  set_strain_rates(const Body<dim>          &body,
                   const MaterialState<dim> &material,
                   const Viscosity<dim>     &viscosity,
                   SecularFlow              &flow)
  {
    using Field                   = QuadratureField<dim>;
    const unsigned int n_branches = material.fluidity.size();
    body.points.initialize(flow.strain_rate, n_branches);
    body.strain_operator.for_each_strain(
      flow.velocity,
      [&](const std::size_t offset, const VoigtVector<dim> &strain_rate) {
        const std::size_t point = offset / Field::n_components;
        for (unsigned int i = 0; i < n_branches; ++i)
          Field::set(flow.strain_rate,
                     offset * n_branches + i * Field::n_components,
                     (*material.fluidity[i])[point] *
                       (viscosity.branches[i][point] * strain_rate));
      });
  }



  template bool
  has_viscosity(const MaterialState<2> &);
  template bool
  has_viscosity(const MaterialState<3> &);
  template Viscosity<2>
  viscosity_of(const MaterialState<2> &, const std::size_t);
  template Viscosity<3>
  viscosity_of(const MaterialState<3> &, const std::size_t);
  template void
  set_strain_rates(const Body<2> &,
                   const MaterialState<2> &,
                   const Viscosity<2> &,
                   SecularFlow &);
  template void
  set_strain_rates(const Body<3> &,
                   const MaterialState<3> &,
                   const Viscosity<3> &,
                   SecularFlow &);
} // namespace Crevasse
