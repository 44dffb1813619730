// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/temperature/simplex_locator.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  SimplexLocator<dim>::SimplexLocator(std::vector<Point<dim>> all_vertices,
                                      std::vector<Simplex>    all_simplices)
    : vertices(std::move(all_vertices))
    , simplices(std::move(all_simplices))
  {
    std::vector<Box> all;
    for (std::size_t i = 0; i < simplices.size(); ++i)
      {
        std::vector<Point<dim>> corners;
        for (const unsigned int vertex : simplices[i])
          corners.push_back(vertices[vertex]);
        BoundingBox<dim> box(corners);
        const auto &[lower, upper] = box.get_boundary_points();
        diameters.push_back(lower.distance(upper));
        box.extend(largest_gap * diameters.back());
        all.emplace_back(box, i);
      }
    boxes = pack_rtree(all);
  }



  template <int dim>
  std::pair<typename SimplexLocator<dim>::Location, double>
  SimplexLocator<dim>::project(const Point<dim> &point,
                               const std::size_t simplex) const
  {
    const Simplex &corners = simplices[simplex];
    Tensor<2, dim> jacobian;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        jacobian[d][i] = vertices[corners[i + 1]][d] - vertices[corners[0]][d];
    Location location{simplex, {}};
    if (!(std::abs(determinant(jacobian)) >
          1e-14 * std::pow(diameters[simplex], dim)))
      return {location, std::numeric_limits<double>::infinity()};

    // The gradients of the barycentric coordinates, and these at the point.
    const Tensor<2, dim>                inverse = invert(jacobian);
    std::array<Tensor<1, dim>, dim + 1> gradients;
    std::array<double, dim + 1>        &weights = location.weights;
    weights[0]                                  = 1.;
    for (unsigned int i = 0; i < dim; ++i)
      {
        gradients[i + 1] = inverse[i];
        gradients[0] -= inverse[i];
        weights[i + 1] = inverse[i] * (point - vertices[corners[0]]);
        weights[0] -= weights[i + 1];
      }

    // Perpendicularly onto each face that the point is beyond; what is left of
    // negative weights then is beyond an edge or a corner.
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
    Point<dim>   place;
    for (unsigned int i = 0; i <= dim; ++i)
      {
        weights[i] /= sum;
        place += weights[i] * vertices[corners[i]];
      }
    return {location, place.distance(point)};
  }



  template <int dim>
  typename SimplexLocator<dim>::Location
  SimplexLocator<dim>::find(const Point<dim> &point) const
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



  template <int dim>
  bool
  SimplexLocator<dim>::interpolate(const Point<dim>          &point,
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



  template class SimplexLocator<2>;
  template class SimplexLocator<3>;
} // namespace Crevasse
