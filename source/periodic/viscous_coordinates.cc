// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/cell_values.h>
#include <crevasse/material/voigt_matrix.h>
#include <crevasse/periodic/viscous_coordinates.h>


namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Lᵀ with η = L Lᵀ. Where η has no 33 row, one that counts for nothing
     * takes its place: the matrix must have an inverse. */
    template <int dim>
    VoigtMatrix<dim>
    root(const VoigtMatrix<dim> &eta)
    {
      constexpr unsigned int n          = n_stress_components<dim>;
      constexpr double       negligible = 1e-6;
      VoigtMatrix<dim>       upper;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = i; j < n; ++j)
          {
            double value = eta[i][j];
            for (unsigned int k = 0; k < i; ++k)
              value -= upper[k][i] * upper[k][j];
            if (j > i)
              upper[i][j] = value / upper[i][i];
            else
              upper[i][i] = eta[i][i] > 0. ? std::sqrt(value)
                                           : negligible * std::sqrt(eta.norm());
          }
      return upper;
    }



    /** Of an upper triangular matrix, column by column from below. */
    template <int dim>
    VoigtMatrix<dim>
    inverse_of_upper(const VoigtMatrix<dim> &upper)
    {
      constexpr unsigned int n = n_stress_components<dim>;
      VoigtMatrix<dim>       result;
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = j + 1; i-- > 0;)
          {
            double value = i == j ? 1. : 0.;
            for (unsigned int k = i + 1; k <= j; ++k)
              value -= upper[i][k] * result[k][j];
            result[i][j] = value / upper[i][i];
          }
      return result;
    }
  } // namespace



  template <int dim>
  ViscousCoordinates<dim>::ViscousCoordinates(
    const Space<dim>           &space,
    const QuadratureField<dim> &points,
    const MaterialState<dim>   &material,
    const double                creep_time)
  {
    constexpr double least = 1e-4; // of what relaxes within a period
    for (std::size_t i = 0; i < material.fractions.size(); ++i)
      {
        const double w = material.fractions[i];
        roots.push_back(combine(
          *material.stiffness,
          *material.fluidity[i],
          points.n_local_points,
          [&](const VoigtMatrix<dim> &K, const VoigtMatrix<dim> &H) {
            const VoigtMatrix<dim> creep =
              creep_time * (material.plane_stress ? in_plane<dim>(H) : H);
            return root<dim>(inverse<dim>(creep + least / w * inverse<dim>(K)));
          }));
        inverses.push_back(Crevasse::transform(roots.back(),
                                               points.n_local_points,
                                               inverse_of_upper<dim>));
      }
    CellValues<dim> cell_values(space, update_JxW_values);
    weights.resize(points.n_local_points);
    for (const auto &cell : space.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const FEValues<dim> &values = cell_values.reinit(cell);
          const std::size_t    first =
            points.offset(cell) / n_stress_components<dim>;
          for (const unsigned int q : values.quadrature_point_indices())
            weights[first + q] = std::sqrt(values.JxW(q));
        }
  }



  template <int dim>
  void
  ViscousCoordinates<dim>::transform(const bool    to_strain,
                                     const Vector &source,
                                     Vector       &target) const
  {
    using Field                           = QuadratureField<dim>;
    const std::vector<Matrices> &matrices = to_strain ? inverses : roots;
    target.reinit(source, true);
    std::size_t offset = 0;
    for (std::size_t point = 0; point < weights.size(); ++point)
      for (const Matrices &of_branch : matrices)
        {
          const double weight = weights[point];
          Field::set(target,
                     offset,
                     (to_strain ? 1. / weight : weight) *
                       (of_branch[point] * Field::get(source, offset)));
          offset += Field::n_components;
        }
  }



  template class ViscousCoordinates<2>;
  template class ViscousCoordinates<3>;
} // namespace Crevasse
