// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_coarser_meshes_h
#define crevasse_discretisation_coarser_meshes_h

#include <crevasse/discretisation/point_values.h>
#include <crevasse/discretisation/quadrature_field.h>

namespace Crevasse
{
  /** A mesh all of whose cells are one level coarser than those of a finer one,
   * where that has all children of a cell. */
  template <int dim>
  struct CoarserMesh
  {
    std::shared_ptr<const Mesh<dim>> mesh;

    /** By active cell index, for locally owned cells: the global active cell
     * indices in the finer mesh of the children, or of the same cell. */
    std::vector<std::vector<dealii::types::global_cell_index>> children;
  };

  /**
   * The meshes that repeated coarsening leads to, from fine to coarse: as far
   * as one has at most @p enough cells or nothing can be coarsened any more.
   * Each is partitioned for itself. Collective.
   */
  template <int dim>
  std::vector<CoarserMesh<dim>>
  coarser_meshes(const Mesh<dim> &mesh, const std::size_t enough);

  /** For each active cell of this rank, by active cell index, the mean of the
   * values at its points; 0 for the cells of other ranks. */
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

  /** The same on a coarser mesh: means over children. Collective. */
  template <int dim>
  std::vector<VoigtMatrix<dim>>
  means_over_children(const Mesh<dim>                     &finer,
                      const CoarserMesh<dim>              &coarser,
                      const std::vector<VoigtMatrix<dim>> &of_finer);
} // namespace Crevasse

#endif
