// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_temperature_simplex_locator_h
#define crevasse_temperature_simplex_locator_h

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/point.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <array>
#include <boost/functional/hash.hpp>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>
#include <unordered_map>

namespace Crevasse
{
  /**
   * Finds the triangle (tetrahedron) that contains a point. The simplices need
   * no neighbours: they may overlap, have either orientation, or share no
   * vertices. Found points are cached, because all instants need the same
   * points.
   */
  template <int dim>
  class SimplexLocator
  {
  public:
    using Simplex = std::array<unsigned int, dim + 1>; ///< vertex numbers

    /** A simplex and barycentric coordinates in it. */
    struct Location
    {
      std::size_t                 simplex;
      std::array<double, dim + 1> weights;
    };

    SimplexLocator(std::vector<dealii::Point<dim>> all_vertices,
                   std::vector<Simplex>            all_simplices)
      : vertices(std::move(all_vertices))
      , simplices(std::move(all_simplices))
    {
      std::vector<Box> all;
      for (std::size_t i = 0; i < simplices.size(); ++i)
        {
          std::vector<dealii::Point<dim>> corners;
          for (const unsigned int vertex : simplices[i])
            corners.push_back(vertices[vertex]);
          dealii::BoundingBox<dim> box(corners);
          const auto &[lower, upper] = box.get_boundary_points();
          diameters.push_back(lower.distance(upper));
          box.extend(largest_gap * diameters.back());
          all.emplace_back(box, i);
        }
      boxes = dealii::pack_rtree(all);
    }

    std::size_t
    n_vertices() const
    {
      return vertices.size();
    }

    /** Interpolates values at vertices linearly at a point; returns false and
     * does not set @p value if the point lies outside. A point in the gap
     * between a curved boundary and the edges or faces that approximate it has
     * the value at the nearest point of a simplex. */
    bool
    interpolate(const dealii::Point<dim>  &point,
                const std::vector<double> &values,
                double                    &value) const
    {
      Coordinates coordinates;
      for (unsigned int d = 0; d < dim; ++d)
        coordinates[d] = point[d];

      const std::lock_guard<std::mutex> lock(guard);
      auto                              place = known.find(coordinates);
      if (place == known.end())
        place = known.emplace(coordinates, find(point)).first;
      const Location &location = place->second;
      if (location.weights == std::array<double, dim + 1>())
        return false;
      value = 0.;
      for (unsigned int i = 0; i <= dim; ++i)
        value += location.weights[i] * values[simplices[location.simplex][i]];
      return true;
    }

    /** Largest bridged gap at curved boundaries, in diameters of the simplex'
     * bounding box: an edge that spans the angle φ leaves φ/8. */
    static constexpr double largest_gap = 0.05;

  private:
    using Coordinates = std::array<double, dim>;
    using Box         = std::pair<dealii::BoundingBox<dim>, std::size_t>;

    /** Finds a point in the simplices; all weights are zero if outside. */
    Location
    find(const dealii::Point<dim> &point) const
    {
      namespace index = boost::geometry::index;

      Location nearest{0, {}};
      double   least = largest_gap;
      for (auto box = boxes.qbegin(index::intersects(point));
           box != boxes.qend() && least > 1e-12;
           ++box)
        {
          const auto [location, distance] = project(point, box->second);
          const double gap                = distance / diameters[box->second];
          if (gap <= least)
            {
              least   = gap;
              nearest = location;
            }
        }
      return nearest;
    }

    /** Point of a simplex that is nearest to a given point, and their distance;
     * infinity for a flat simplex. */
    std::pair<Location, double>
    project(const dealii::Point<dim> &point, const std::size_t simplex) const
    {
      const Simplex         &corners = simplices[simplex];
      dealii::Tensor<2, dim> jacobian;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int d = 0; d < dim; ++d)
          jacobian[d][i] =
            vertices[corners[i + 1]][d] - vertices[corners[0]][d];
      Location location{simplex, {}};
      if (!(std::abs(dealii::determinant(jacobian)) >
            1e-14 * std::pow(diameters[simplex], dim)))
        return {location, std::numeric_limits<double>::infinity()};

      // Gradients of barycentric coordinates, and their values at the point.
      const dealii::Tensor<2, dim> inverse = dealii::invert(jacobian);
      std::array<dealii::Tensor<1, dim>, dim + 1> gradients;
      std::array<double, dim + 1>                &weights = location.weights;
      weights[0]                                          = 1.;
      for (unsigned int i = 0; i < dim; ++i)
        {
          gradients[i + 1] = inverse[i];
          gradients[0] -= inverse[i];
          weights[i + 1] = inverse[i] * (point - vertices[corners[0]]);
          weights[0] -= weights[i + 1];
        }

      // Project perpendicularly onto each face that the point is beyond;
      // weights that stay negative belong to a point beyond an edge or corner.
      for (unsigned int i = 0; i <= dim; ++i)
        if (weights[i] < 0.)
          {
            const double step = weights[i] / gradients[i].norm_square();
            for (unsigned int j = 0; j <= dim; ++j)
              weights[j] -= step * (gradients[i] * gradients[j]);
          }
      for (double &weight : weights)
        weight = std::max(weight, 0.);
      const double sum = std::accumulate(weights.begin(), weights.end(), 0.);
      dealii::Point<dim> place;
      for (unsigned int i = 0; i <= dim; ++i)
        {
          weights[i] /= sum;
          place += weights[i] * vertices[corners[i]];
        }
      return {location, place.distance(point)};
    }

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
