// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_coarser_meshes_h
#define crevasse_discretisation_coarser_meshes_h

#include <crevasse/discretisation/point_values.h>
#include <crevasse/discretisation/quadrature_field.h>

namespace Crevasse
{
  /** A mesh made from a finer one by replacing all children of a cell by this
   * cell, wherever possible. */
  template <int dim>
  struct CoarserMesh
  {
    std::shared_ptr<const Mesh<dim>> mesh;

    /** Global active cell indices, in the finer mesh, of the children of each
     * locally owned cell, or of the cell itself; by active cell index. */
    std::vector<std::vector<dealii::types::global_cell_index>> children;
  };

  /**
   * Meshes by repeated coarsening, from fine to coarse, until one has at most
   * @p enough cells or nothing can be coarsened. Each has its own partition.
   * Collective.
   */
  template <int dim>
  std::vector<CoarserMesh<dim>>
  coarser_meshes(const Mesh<dim> &mesh, const std::size_t enough);

  /** Mean of values over the points of each active cell of this rank, by active
   * cell index; 0 for the cells of other ranks. */
  template <int dim, typename Value>
  std::vector<Value>
  cell_means(const Space<dim>           &space,
             const QuadratureField<dim> &points,
             const PointValues<Value>   &values)
  {
    std::vector<Value> means(space.mesh().n_active_cells());
    for (const auto &cell : owned_cells(space.mesh()))
      {
        const unsigned int n    = space.quadrature(cell).size();
        Value             &mean = means[cell->active_cell_index()];
        for (unsigned int q = 0; q < n; ++q)
          mean += values[points.first_point(cell) + q];
        mean /= n;
      }
    return means;
  }

  /** Cell means on a coarser mesh: means over children. Collective. */
  template <int dim>
  std::vector<VoigtMatrix<dim>>
  means_over_children(const Mesh<dim>                     &finer,
                      const CoarserMesh<dim>              &coarser,
                      const std::vector<VoigtMatrix<dim>> &of_finer);
} // namespace Crevasse

#endif
