// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/cell_loops.h>

#include <deal.II/fe/fe_tools.h>

#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Number of entries behind the last cell that a batch may read: one less
     * than the largest number of lanes. */
    constexpr unsigned int padding = 15;
  } // namespace



  template <int dim>
  CellLoops<dim>::CellLoops(const Space<dim> &space)
    : space(space)
    , kind{dim,
           space.finite_element.degree,
           static_cast<unsigned int>(
             space.finite_element.degree +
             (space.singular_shapes() == nullptr ? 1 : 2)),
           space.volumetric_strain == VolumetricStrain::mean,
           space.roles.has_axis}
    , n_nodes(space.finite_element.n_dofs_per_cell() / dim)
    , place_of_dof(space.finite_element.n_dofs_per_cell())
  {
    const FESystem<dim> &fe = space.finite_element;
    const auto           lexicographic =
      FETools::hierarchic_to_lexicographic_numbering<dim>(fe.degree);
    for (unsigned int i = 0; i < place_of_dof.size(); ++i)
      {
        const auto [component, node] = fe.system_to_component_index(i);
        place_of_dof[i]              = lexicographic[node] * dim + component;
      }
    for_each_cell([&](const auto &, const unsigned int) { ++n; });
    find_constraints();
    number_nodes();
  }



  template <int dim>
  void
  CellLoops<dim>::find_constraints()
  {
    using Dofs             = std::vector<types::global_dof_index>;
    const IndexSet &owned  = space.locally_owned_unknowns;
    const auto      to_set = [&](Dofs &dofs) {
      std::sort(dofs.begin(), dofs.end());
      IndexSet set(owned.size());
      set.add_indices(dofs.begin(), dofs.end());
      return set;
    };
    Dofs not_owned, dofs(place_of_dof.size());
    for (const auto &cell : owned_cells(space.dof_handler))
      {
        cell->get_dof_indices(dofs);
        for (const auto dof : dofs)
          if (!owned.is_element(dof))
            not_owned.push_back(dof);
      }
    const IndexSet ghosts_of_cells = to_set(not_owned);
    const auto     for_each_line   = [&](const auto &f) {
      for (const auto &line : space.constraints.get_lines())
        if (owned.is_element(line.index) ||
            ghosts_of_cells.is_element(line.index))
          f(line);
    };
    for_each_line([&](const auto &line) {
      for (const auto &master : line.entries)
        if (!owned.is_element(master.first))
          not_owned.push_back(master.first);
    });
    partitioner =
      std::make_shared<const Utilities::MPI::Partitioner>(owned,
                                                          to_set(not_owned),
                                                          space.communicator());
    for_each_line([&](const auto &line) {
      const unsigned int index = partitioner->global_to_local(line.index);
      constrained_indices.push_back(index);
      if (owned.is_element(line.index))
        owned_constrained.push_back(index);
      for (const auto &[master, weight] : line.entries)
        weights.emplace_back(partitioner->global_to_local(master), weight);
      starts.push_back(weights.size());
    });
    std::sort(owned_constrained.begin(), owned_constrained.end());
  }



  template <int dim>
  void
  CellLoops<dim>::number_nodes()
  {
    indices.resize((n + padding) * std::size_t(n_nodes));
    std::vector<types::global_dof_index> dofs(place_of_dof.size());
    for_each_cell([&](const auto &cell, const unsigned int k) {
      cell->get_dof_indices(dofs);
      unsigned int *const of_cell = indices.data() + std::size_t(k) * n_nodes;
      for (unsigned int i = 0; i < dofs.size(); ++i)
        if (place_of_dof[i] % dim == 0)
          of_cell[place_of_dof[i] / dim] =
            partitioner->global_to_local(dofs[i]);
      for (unsigned int i = 0; i < dofs.size(); ++i)
        AssertThrow(partitioner->global_to_local(dofs[i]) ==
                      of_cell[place_of_dof[i] / dim] + place_of_dof[i] % dim,
                    ExcInternalError());
    });
    if (n > 0)
      for (unsigned int k = n; k < n + padding; ++k)
        std::copy_n(first_indices(n - 1),
                    n_nodes,
                    indices.data() + std::size_t(k) * n_nodes);
  }



  template <int dim>
  template <typename Real>
  CellBatches<Real>
  CellLoops<dim>::batches(const unsigned int first,
                          const unsigned int at_most) const
  {
    const Geometry<Real> &all        = geometry<Real>();
    const unsigned int    n_lanes    = all.kernels.n_lanes;
    const unsigned int    first_cell = std::min(first * n_lanes, n);
    const unsigned int    n_cells =
      at_most > n / n_lanes ? n - first_cell
                               : std::min(n - first_cell, at_most * n_lanes);
    return {n_cells,
            first_indices(first_cell),
            all.of_batch.data() + first,
            all.values.data()};
  }



  template <int dim>
  template <typename Real>
  const typename CellLoops<dim>::template Geometry<Real> &
  CellLoops<dim>::geometry() const
  {
    auto &of_precision =
      std::get<std::unique_ptr<const Geometry<Real>>>(geometries);
    if (of_precision == nullptr)
      of_precision = make_geometry<Real>();
    return *of_precision;
  }



  template <int dim>
  template <typename Real>
  CellLoops<dim>::ResolvedValues<Real>::ResolvedValues(
    const CellLoops      &loops,
    const VectorOf<Real> &vector)
    : loops(loops)
    , vector(vector)
  {
    vector.update_ghost_values();
    // Constrained entries, like ghost values, are not part of a vector's value.
    Real *const values = const_cast<VectorOf<Real> &>(vector).begin();
    own_values.reserve(loops.constrained_indices.size());
    for (const unsigned int index : loops.constrained_indices)
      own_values.push_back(values[index]);
    for (std::size_t k = 0; k < loops.constrained_indices.size(); ++k)
      {
        Real sum = 0;
        for (std::size_t e = loops.starts[k]; e < loops.starts[k + 1]; ++e)
          sum += Real(loops.weights[e].second) * values[loops.weights[e].first];
        values[loops.constrained_indices[k]] = sum;
      }
  }



  template <int dim>
  template <typename Real>
  CellLoops<dim>::ResolvedValues<Real>::~ResolvedValues()
  {
    Real *const values = const_cast<VectorOf<Real> &>(vector).begin();
    for (std::size_t k = 0; k < loops.constrained_indices.size(); ++k)
      values[loops.constrained_indices[k]] = own_values[k];
    vector.zero_out_ghost_values();
  }



  template <int dim>
  template <typename Real>
  void
  CellLoops<dim>::distribute(VectorOf<Real> &vector) const
  {
    Real *const values = vector.begin();
    for (std::size_t k = 0; k < constrained_indices.size(); ++k)
      {
        const Real value               = values[constrained_indices[k]];
        values[constrained_indices[k]] = 0;
        for (std::size_t e = starts[k]; e < starts[k + 1]; ++e)
          values[weights[e].first] += Real(weights[e].second) * value;
      }
    vector.compress(VectorOperation::add);
  }



  template <int dim>
  std::size_t
  CellLoops<dim>::memory_consumption() const
  {
    std::size_t bytes =
      (indices.size() + constrained_indices.size() + owned_constrained.size()) *
        sizeof(unsigned int) +
      starts.size() * sizeof(starts[0]) + weights.size() * sizeof(weights[0]) +
      partitioner->memory_consumption();
    const auto add = [&](const auto &geometry) {
      if (geometry != nullptr)
        bytes += geometry->of_batch.size() * sizeof(BatchGeometry) +
                 geometry->values.memory_consumption();
    };
    add(std::get<0>(geometries));
    add(std::get<1>(geometries));
    return bytes;
  }



#define INSTANTIATE(dim, Real)                                                 \
  template CellBatches<Real> CellLoops<dim>::batches<Real>(const unsigned int, \
                                                           const unsigned int) \
    const;                                                                     \
  template const CellLoops<dim>::Geometry<Real>                                \
    &CellLoops<dim>::geometry<Real>() const;                                   \
  template class CellLoops<dim>::ResolvedValues<Real>;                         \
  template void CellLoops<dim>::distribute<Real>(VectorOf<Real> &) const;

  template class CellLoops<2>;
  template class CellLoops<3>;
  INSTANTIATE(2, float)
  INSTANTIATE(2, double)
  INSTANTIATE(3, float)
  INSTANTIATE(3, double)
#undef INSTANTIATE
} // namespace Crevasse
