// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/material/voigt_matrix.h>
#include <crevasse/model/secular.h>

namespace Crevasse
{
  namespace
  {
    template <int dim>
    using Matrices = PointValues<VoigtMatrix<dim>>;



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
    std::vector<Matrices<dim>> branches;
    for (const auto &fluidity : material.fluidity)
      branches.push_back(
        transform(*fluidity, n_points, [&](const VoigtMatrix<dim> &H) {
          return inverse<dim>(bearing_part<dim>(H, material.plane_stress));
        }));
    Matrices<dim> sum = branches.front();
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
  SecularFlow
  secular_flow_of(const StrainOperator<dim>  &strain_operator,
                  const QuadratureField<dim> &points,
                  const MaterialState<dim>   &material,
                  const Viscosity<dim>       &viscosity,
                  const Vector               &mean_load,
                  const double                time,
                  ContactSolver              &contact_solver)
  {
    using Field                   = QuadratureField<dim>;
    const unsigned int n_branches = material.fluidity.size();

    SecularFlow flow;
    strain_operator.initialize(flow.velocity);
    points.initialize(flow.strain_rate, n_branches);
    contact_solver.solve(mean_load, flow.velocity, flow.contact_forces);
    flow.velocity /= time;

    // αᵢ = Hᵢ ηᵢ Dβ: that is Dβ, and the creep in thickness with it.
    strain_operator.for_each_strain(
      flow.velocity,
      [&](const std::size_t offset, const VoigtVector<dim> &strain_rate) {
        const std::size_t point = offset / Field::n_components;
        for (unsigned int i = 0; i < n_branches; ++i)
          Field::set(flow.strain_rate,
                     offset * n_branches + i * Field::n_components,
                     (*material.fluidity[i])[point] *
                       (viscosity.branches[i][point] * strain_rate));
      });
    return flow;
  }



#define INSTANTIATE(dim)                                                     \
  template bool           has_viscosity<dim>(const MaterialState<dim> &);    \
  template Viscosity<dim> viscosity_of<dim>(const MaterialState<dim> &,      \
                                            const std::size_t);              \
  template SecularFlow    secular_flow_of<dim>(const StrainOperator<dim> &,  \
                                            const QuadratureField<dim> &, \
                                            const MaterialState<dim> &,   \
                                            const Viscosity<dim> &,       \
                                            const Vector &,               \
                                            const double,                 \
                                            ContactSolver &)

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
