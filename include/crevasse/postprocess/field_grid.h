// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_field_grid_h
#define crevasse_postprocess_field_grid_h

#include <crevasse/discretisation/stress_recovery.h>
#include <crevasse/postprocess/vtu_file.h>


namespace Crevasse
{
  /** What fields are written on: a point for each node and each material that
   * meets there, of the cells of this rank, and linear cells between the nodes
   * of a cell. */
  template <int dim>
  class FieldGrid
  {
  public:
    /** @param recovery must outlive this object. */
    FieldGrid(const Space<dim> &space, const StressRecovery<dim> &recovery);

    std::size_t
    n_points() const
    {
      return coordinates.size() / 3;
    }

    /** Of values at the nodes, with ghosts: a scalar or a vector. */
    PointArray
    nodal(const std::string             &name,
          const dealii::DoFHandler<dim> &dofs,
          const Vector                  &values) const;

    /** Of a field at quadrature points. Collective. */
    std::vector<VoigtVector<dim>>
    recovered(const Vector &field) const;

    /** @param component value(number of the point) */
    template <typename Component>
    PointArray
    scalar(const std::string &name, const Component &component) const
    {
      PointArray array{name, 1, std::vector<float>(n_points())};
      for (std::size_t p = 0; p < n_points(); ++p)
        array.values[p] = component(p);
      return array;
    }

    VtuGrid
    file() const
    {
      return VtuGrid(coordinates, corners, 1 << dim);
    }

  private:
    template <typename Cell>
    unsigned int
    point(const Cell &cell, const unsigned int node) const
    {
      return points[cell->active_cell_index() * nodes_per_cell + node];
    }

    const StressRecovery<dim> &recovery;
    const std::size_t          nodes_per_cell;
    std::vector<unsigned int>  points; ///< of nodes, by active cell index
    std::vector<float>         coordinates;
    std::vector<std::int32_t>  corners;
  };
} // namespace Crevasse

#endif
