// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/temperature/cell_locator.h>

#include <deal.II/base/geometry_info.h>

#include <algorithm>
#include <boost/functional/hash.hpp>
#include <cmath>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    double
    shape_value(const bool         is_simplex,
                const Point<dim>  &place,
                const unsigned int corner)
    {
      if (!is_simplex)
        return GeometryInfo<dim>::d_linear_shape_function(place, corner);
      if (corner > 0)
        return place[corner - 1];
      double value = 1.;
      for (unsigned int d = 0; d < dim; ++d)
        value -= place[d];
      return value;
    }



    template <int dim>
    Tensor<1, dim>
    shape_gradient(const bool         is_simplex,
                   const Point<dim>  &place,
                   const unsigned int corner)
    {
      if (!is_simplex)
        return GeometryInfo<dim>::d_linear_shape_function_gradient(place,
                                                                   corner);
      Tensor<1, dim> gradient;
      for (unsigned int d = 0; d < dim; ++d)
        gradient[d] = corner == 0 ? -1. : (corner == d + 1 ? 1. : 0.);
      return gradient;
    }



    /** A place on the reference cell next to the given one. */
    template <int dim>
    Point<dim>
    clip(const bool is_simplex, Point<dim> place)
    {
      double sum = 0.;
      for (unsigned int d = 0; d < dim; ++d)
        {
          place[d] = std::clamp(place[d], 0., 1.);
          sum += place[d];
        }
      if (is_simplex && sum > 1.)
        place /= sum;
      return place;
    }
  } // namespace



  template <int dim>
  bool
  CellMesh<dim>::operator==(const CellMesh &other) const
  {
    return begins == other.begins && corners == other.corners &&
           vertices == other.vertices;
  }



  template <int dim>
  std::size_t
  CellLocator<dim>::Hash::operator()(
    const std::array<double, dim> &coordinates) const
  {
    return boost::hash_range(coordinates.begin(), coordinates.end());
  }



  template <int dim>
  CellLocator<dim>::CellLocator(CellMesh<dim> mesh)
    : cells(std::move(mesh))
  {
    std::vector<Box> all;
    for (std::size_t cell = 0; cell + 1 < cells.begins.size(); ++cell)
      {
        std::vector<Point<dim>> corners;
        for (std::size_t c = cells.begins[cell]; c < cells.begins[cell + 1];
             ++c)
          corners.push_back(cells.vertices[cells.corners[c]]);
        BoundingBox<dim> box(corners);
        const auto &[lower, upper] = box.get_boundary_points();
        diameters.push_back(lower.distance(upper));
        box.extend(largest_gap * diameters.back());
        all.emplace_back(box, cell);
      }
    boxes = pack_rtree(all);
  }



  template <int dim>
  const CellMesh<dim> &
  CellLocator<dim>::mesh() const
  {
    return cells;
  }



  template <int dim>
  Point<dim>
  CellLocator<dim>::push_forward(const Location &location) const
  {
    const std::size_t  begin = cells.begins[location.cell];
    const unsigned int n     = cells.begins[location.cell + 1] - begin;
    Point<dim>         point;
    for (unsigned int c = 0; c < n; ++c)
      point += shape_value(n == dim + 1, location.place, c) *
               cells.vertices[cells.corners[begin + c]];
    return point;
  }



  template <int dim>
  std::optional<Point<dim>>
  CellLocator<dim>::pull_back(const std::size_t cell,
                              const Point<dim> &point) const
  {
    const std::size_t  begin      = cells.begins[cell];
    const unsigned int n          = cells.begins[cell + 1] - begin;
    const bool         is_simplex = n == dim + 1;

    Location location{cell, Point<dim>()};
    for (unsigned int d = 0; d < dim; ++d)
      location.place[d] = is_simplex ? 1. / (dim + 1) : 0.5;
    constexpr unsigned int most_steps = 20;
    for (unsigned int step = 0; step < most_steps; ++step)
      {
        Tensor<2, dim> jacobian;
        for (unsigned int c = 0; c < n; ++c)
          jacobian +=
            outer_product(cells.vertices[cells.corners[begin + c]],
                          shape_gradient(is_simplex, location.place, c));
        // A flat cell contains nothing.
        if (!(std::abs(determinant(jacobian)) >
              1e-14 * std::pow(diameters[cell], dim)))
          return {};
        const Tensor<1, dim> change =
          invert(jacobian) * (point - push_forward(location));
        location.place += change;
        // The last step's size only says what rounding leaves.
        if (change.norm() < 1e-12 ||
            (step + 1 == most_steps && change.norm() < 1e-6))
          return location.place;
        if (!(location.place.norm() < 1e3))
          return {};
      }
    return {};
  }



  template <int dim>
  std::optional<typename CellLocator<dim>::Location>
  CellLocator<dim>::find(const Point<dim> &point) const
  {
    namespace index = boost::geometry::index;

    std::optional<Location> nearest;
    double                  least = largest_gap;
    for (auto box = boxes.qbegin(index::intersects(point)); box != boxes.qend();
         ++box)
      {
        const std::size_t cell  = box->second;
        const auto        place = pull_back(cell, point);
        if (!place)
          continue;
        const bool is_simplex =
          cells.begins[cell + 1] - cells.begins[cell] == dim + 1;
        const Location location{cell, clip(is_simplex, *place)};
        const double   gap =
          push_forward(location).distance(point) / diameters[cell];
        if (gap > least)
          continue;
        least   = gap;
        nearest = location;
        if (least < 1e-12)
          break;
      }
    return nearest;
  }



  template <int dim>
  std::optional<double>
  CellLocator<dim>::value(const Point<dim>          &point,
                          const std::vector<double> &values) const
  {
    std::array<double, dim> coordinates;
    for (unsigned int d = 0; d < dim; ++d)
      coordinates[d] = point[d];

    const std::lock_guard<std::mutex> lock(guard);
    auto                              place = known.find(coordinates);
    if (place == known.end())
      {
        const auto location = find(point);
        if (!location)
          return {};
        place = known.emplace(coordinates, *location).first;
      }
    const Location    &location = place->second;
    const std::size_t  begin    = cells.begins[location.cell];
    const unsigned int n        = cells.begins[location.cell + 1] - begin;
    double             sum      = 0.;
    for (unsigned int c = 0; c < n; ++c)
      sum += shape_value(n == dim + 1, location.place, c) *
             values[cells.corners[begin + c]];
    return sum;
  }



  template struct CellMesh<2>;
  template struct CellMesh<3>;
  template class CellLocator<2>;
  template class CellLocator<3>;
} // namespace Crevasse
