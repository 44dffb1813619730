// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/linear/point_moduli.h>
#include <crevasse/linear/stiffness_product.h>

#include <deal.II/base/utilities.h>

#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  template <int dim, typename Real>
  StiffnessProduct<dim, Real>::StiffnessProduct(
    const Space<dim>                    &space,
    const QuadratureField<dim>          &points,
    const PointValues<VoigtMatrix<dim>> &stiffness,
    const double                         unit)
    : loops(space.cell_loops())
    , kernels(loops->template kernels<Real>())
  {
    const bool with_out_of_plane =
      space.volumetric_strain == VolumetricStrain::mean || space.roles.has_axis;
    bool is_isotropic = true;
    for (const VoigtMatrix<dim> &K : stiffness.distinct())
      is_isotropic =
        is_isotropic && IsotropicModuli<dim>::represents(K, with_out_of_plane);
    // All ranks use isotropic moduli, or none.
    moduli.is_isotropic =
      Utilities::MPI::min(is_isotropic ? 1 : 0, space.communicator()) == 1;
    if (moduli.is_isotropic)
      pack_moduli<IsotropicModuli<dim>>(space, points, stiffness, unit);
    else
      pack_moduli<GeneralModuli<dim>>(space, points, stiffness, unit);
    compute_diagonal(space);
  }



  template <int dim, typename Real>
  template <typename PointModuli>
  void
  StiffnessProduct<dim, Real>::pack_moduli(
    const Space<dim>                    &space,
    const QuadratureField<dim>          &points,
    const PointValues<VoigtMatrix<dim>> &stiffness,
    const double                         unit)
  {
    const unsigned int       n_points = space.quadratures[0].size();
    std::vector<std::size_t> first_points;
    bool                     varies_in_cells = false;
    if (!stiffness.is_uniform())
      loops->for_each_cell([&](const auto &cell, const unsigned int) {
        const std::size_t first = points.first_point(cell);
        first_points.push_back(first);
        for (unsigned int q = 1; q < n_points && !varies_in_cells; ++q)
          varies_in_cells =
            stiffness.index(first + q) != stiffness.index(first) &&
            stiffness[first + q] != stiffness[first];
      });

    const unsigned int n_lanes   = kernels.n_lanes;
    const unsigned int n_cells   = first_points.size();
    const unsigned int n_batches = (n_cells + n_lanes - 1) / n_lanes;
    const unsigned int n_values  = PointModuli::n_values;
    const unsigned int n_sets    = varies_in_cells ? n_points : 1;
    moduli.per_point             = varies_in_cells ? n_values * n_lanes : 0;
    moduli.per_batch = stiffness.is_uniform() ? 0 : n_sets * n_values * n_lanes;
    values_of_moduli.resize((stiffness.is_uniform() ? 1 : n_sets * n_batches) *
                            n_values * n_lanes);
    moduli.values = values_of_moduli.data();
    Real *value   = values_of_moduli.data();
    for (unsigned int batch = 0;
         batch < (stiffness.is_uniform() ? 1 : n_batches);
         ++batch)
      for (unsigned int q = 0; q < n_sets; ++q, value += n_values * n_lanes)
        for (unsigned int lane = 0; lane < n_lanes; ++lane)
          {
            const unsigned int cell = batch * n_lanes + lane;
            const PointModuli  of_point(
              stiffness[stiffness.is_uniform()
                           ? 0
                           : first_points[std::min(cell, n_cells - 1)] + q]);
            for (unsigned int k = 0; k < n_values; ++k)
              value[k * n_lanes + lane] = of_point.values[k] / unit;
          }
  }



  template <int dim, typename Real>
  void
  StiffnessProduct<dim, Real>::vmult(Vector              &result,
                                     const Vector        &v,
                                     const RangeFunction &before,
                                     const RangeFunction &after) const
  {
    const unsigned int n = v.locally_owned_size();
    before(0, n);
    result.zero_out_ghost_values();
    {
      const typename CellLoops<dim>::template ResolvedValues<Real> resolved(
        *loops, v);
      kernels.multiply(loops->template batches<Real>(),
                       moduli,
                       v.begin(),
                       result.begin());
    }
    loops->distribute(result);
    for (const auto *rows : {&loops->constrained(), &held_rows})
      for (const unsigned int row : *rows)
        result.local_element(row) = v.local_element(row);
    after(0, n);
  }



  template <int dim, typename Real>
  void
  StiffnessProduct<dim, Real>::vmult(Vector &result, const Vector &v) const
  {
    vmult(
      result,
      v,
      [&](const unsigned int begin, const unsigned int end) {
        std::fill(result.begin() + begin, result.begin() + end, Real(0));
      },
      [](const unsigned int, const unsigned int) {});
  }



  template <int dim, typename Real>
  void
  StiffnessProduct<dim, Real>::compute_diagonal(const Space<dim> &space)
  {
    const unsigned int n_lanes = kernels.n_lanes;
    const unsigned int n_nodes = loops->n_nodes_per_cell();
    const unsigned int n_dofs  = n_nodes * dim;

    // Diagonals of separate cells: products with their unit vectors.
    std::vector<unsigned int> own_indices(n_nodes * n_lanes);
    for (unsigned int node = 0; node < own_indices.size(); ++node)
      own_indices[node] = node * dim;
    std::vector<Real> unit_vector(n_dofs * n_lanes), column(n_dofs * n_lanes),
      entries(n_dofs * n_lanes);
    std::size_t last_geometry = -1;
    const Real *last_moduli   = nullptr;
    const auto  compute_batch = [&](const unsigned int batch) {
      CellBatches<Real> cells    = loops->template batches<Real>(batch, 1);
      BatchModuli<Real> of_batch = moduli;
      of_batch.values += batch * moduli.per_batch;
      const bool is_like_last = cells.geometries->start == last_geometry &&
                                std::equal(last_moduli,
                                           last_moduli + moduli.per_batch,
                                           of_batch.values);
      last_geometry = cells.geometries->start;
      last_moduli   = of_batch.values;
      if (is_like_last)
        return;
      cells.first_indices = own_indices.data();
      for (unsigned int i = 0; i < n_dofs; ++i)
        {
          for (unsigned int lane = 0; lane < n_lanes; ++lane)
            unit_vector[lane * n_dofs + i] = 1;
          std::fill(column.begin(), column.end(), Real(0));
          kernels.multiply(cells, of_batch, unit_vector.data(), column.data());
          for (unsigned int lane = 0; lane < n_lanes; ++lane)
            {
              entries[lane * n_dofs + i]     = column[lane * n_dofs + i];
              unit_vector[lane * n_dofs + i] = 0;
            }
        }
    };

    initialize(operator_diagonal);
    std::vector<types::global_dof_index> dofs(n_dofs);
    loops->for_each_cell([&](const auto &cell, const unsigned int k) {
      if (k % n_lanes == 0)
        compute_batch(k / n_lanes);
      const Real *const of_cell = &entries[k % n_lanes * n_dofs];
      cell->get_dof_indices(dofs);
      for (unsigned int i = 0; i < n_dofs; ++i)
        {
          const Real entry = of_cell[loops->places()[i]];
          if (const auto *masters =
                space.constraints.get_constraint_entries(dofs[i]))
            for (const auto &[master, factor] : *masters)
              operator_diagonal(master) += factor * factor * entry;
          else
            operator_diagonal(dofs[i]) += entry;
        }
    });
    operator_diagonal.compress(VectorOperation::add);
    for (const unsigned int row : loops->constrained())
      operator_diagonal.local_element(row) = 1;
  }



  template <int dim, typename Real>
  std::size_t
  StiffnessProduct<dim, Real>::memory_consumption() const
  {
    return values_of_moduli.memory_consumption() +
           held_rows.size() * sizeof(unsigned int) +
           operator_diagonal.memory_consumption();
  }



  template class StiffnessProduct<2, float>;
  template class StiffnessProduct<3, float>;
  template class StiffnessProduct<2, double>;
  template class StiffnessProduct<3, double>;
} // namespace Crevasse
