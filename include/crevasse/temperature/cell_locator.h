// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_temperature_cell_locator_h
#define crevasse_temperature_cell_locator_h

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/point.h>
#include <deal.II/numerics/rtree.h>

#include <array>
#include <mutex>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace Crevasse
{
  /** The linear cells of a mesh, without neighbours: they may be of different
   * kinds, hang, turn either way round or have vertices of their own. */
  template <int dim>
  struct CellMesh
  {
    std::vector<dealii::Point<dim>> vertices;
    /** Of all cells, one after the other, in deal.II's order. */
    std::vector<unsigned int> corners;
    /** Where in @p corners each cell begins, and the end of the last one. A
     * cell with dim + 1 corners is a simplex, others are hypercubes. */
    std::vector<std::size_t> begins = {0};

    bool
    operator==(const CellMesh &other) const;
  };

  /**
   * Interpolates values at the vertices of a mesh to any points, each of which
   * is looked for once: the same will be asked for at all instants.
   */
  template <int dim>
  class CellLocator
  {
  public:
    explicit CellLocator(CellMesh<dim> mesh);

    const CellMesh<dim> &
    mesh() const;

    /** The value at a point; nothing if it lies outside. A point in the gap
     * between a curved boundary and the edges or faces that stand for it has
     * the value at the place in a cell that is next to it. */
    std::optional<double>
    value(const dealii::Point<dim>  &point,
          const std::vector<double> &values) const;

    /** Width of the gap that is bridged, in diameters of the cell: an edge that
     * spans the angle φ leaves φ/8. */
    static constexpr double largest_gap = 0.05;

  private:
    struct Location
    {
      std::size_t        cell;
      dealii::Point<dim> place; ///< on the reference cell
    };

    struct Hash
    {
      std::size_t
      operator()(const std::array<double, dim> &coordinates) const;
    };

    using Box = std::pair<dealii::BoundingBox<dim>, std::size_t>;

    std::optional<Location>
    find(const dealii::Point<dim> &point) const;

    /** Where a point is in the coordinates of a cell, by Newton's method;
     * nothing if it does not converge, which is so only far outside. */
    std::optional<dealii::Point<dim>>
    pull_back(const std::size_t cell, const dealii::Point<dim> &point) const;

    dealii::Point<dim>
    push_forward(const Location &location) const;

    const CellMesh<dim> cells;
    std::vector<double> diameters;
    dealii::RTree<Box>  boxes;

    mutable std::mutex                                                  guard;
    mutable std::unordered_map<std::array<double, dim>, Location, Hash> known;
  };
} // namespace Crevasse

#endif
