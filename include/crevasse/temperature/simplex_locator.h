// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_temperature_simplex_locator_h
#define crevasse_temperature_simplex_locator_h

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/point.h>
#include <deal.II/numerics/rtree.h>

#include <array>
#include <boost/functional/hash.hpp>
#include <mutex>
#include <unordered_map>
#include <utility>
#include <vector>

namespace Crevasse
{
  /**
   * Finds the triangle (tetrahedron) in which a point lies. The simplices need
   * no neighbours: they may overlap, have either orientation, or share no
   * vertices. Every point is looked for once, because the same points are asked
   * for at all instants.
   */
  template <int dim>
  class SimplexLocator
  {
  public:
    using Simplex = std::array<unsigned int, dim + 1>; ///< its vertices

    /** The barycentric coordinates of a point in a simplex. */
    struct Location
    {
      std::size_t                 simplex;
      std::array<double, dim + 1> weights;
    };

    SimplexLocator(std::vector<dealii::Point<dim>> vertices,
                   std::vector<Simplex>            simplices);

    std::size_t
    n_vertices() const
    {
      return vertices.size();
    }

    /** The linear interpolation of values at the vertices; nothing is written
     * to @p value, and false returned, if the point lies outside. A point in
     * the gap between a curved boundary and the edges or faces that stand for
     * it has the value at the nearest place in a simplex. */
    bool
    interpolate(const dealii::Point<dim>  &point,
                const std::vector<double> &values,
                double                    &value) const;

    /** Width of the gap that is bridged, in diameters of the simplex' bounding
     * box: an edge that spans the angle φ leaves φ/8. */
    static constexpr double largest_gap = 0.05;

  private:
    using Coordinates = std::array<double, dim>;
    using Box         = std::pair<dealii::BoundingBox<dim>, std::size_t>;

    /** Weights that are all zero if the point lies outside. */
    Location
    find(const dealii::Point<dim> &point) const;

    /** The place in a simplex that is nearest to the point, and the distance
     * from it; infinity for a flat simplex. */
    std::pair<Location, double>
    project(const dealii::Point<dim> &point, const std::size_t simplex) const;

    const std::vector<dealii::Point<dim>> vertices;
    const std::vector<Simplex>            simplices;
    std::vector<double>                   diameters;
    dealii::RTree<Box>                    boxes;

    mutable std::mutex guard;
    mutable std::unordered_map<Coordinates, Location, boost::hash<Coordinates>>
      known;
  };
} // namespace Crevasse

#endif
