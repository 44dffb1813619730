// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#include <crevasse/material/voigt_matrix.h>
#include <crevasse/periodic/secular.h>

#include <map>

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



    template <int dim>
    Matrices<dim>
    inverse_of(const Matrices<dim> &fluidity,
               const bool           plane_stress,
               const std::size_t    n_points)
    {
      std::vector<VoigtMatrix<dim>> values;
      for (const VoigtMatrix<dim> &H : fluidity.distinct())
        values.push_back(inverse<dim>(bearing_part<dim>(H, plane_stress)));
      if (fluidity.is_uniform())
        return Matrices<dim>(values.front());
      std::vector<std::uint32_t> which(n_points);
      for (std::size_t p = 0; p < n_points; ++p)
        which[p] = fluidity.index(p);
      return Matrices<dim>(std::move(values), std::move(which));
    }



    template <int dim>
    Matrices<dim>
    sum_of(const std::vector<Matrices<dim>> &branches,
           const std::size_t                 n_points)
    {
      const auto sum_at = [&](const std::size_t p) {
        VoigtMatrix<dim> sum;
        for (const auto &branch : branches)
          sum += branch[p];
        return sum;
      };
      bool is_uniform = true;
      for (const auto &branch : branches)
        is_uniform = is_uniform && branch.is_uniform();
      if (is_uniform)
        return Matrices<dim>(sum_at(0));

      std::vector<VoigtMatrix<dim>>                     values;
      std::vector<std::uint32_t>                        which(n_points);
      std::map<std::vector<std::size_t>, std::uint32_t> numbers;
      std::vector<std::size_t>                          key(branches.size());
      for (std::size_t p = 0; p < n_points; ++p)
        {
          for (unsigned int i = 0; i < branches.size(); ++i)
            key[i] = branches[i].index(p);
          const auto [number, is_new] = numbers.emplace(key, values.size());
          if (is_new)
            values.push_back(sum_at(p));
          which[p] = number->second;
        }
      return Matrices<dim>(std::move(values), std::move(which));
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
        inverse_of<dim>(*fluidity, material.plane_stress, n_points));
    Matrices<dim> sum = sum_of<dim>(branches, n_points);
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
} // namespace Crevasse
