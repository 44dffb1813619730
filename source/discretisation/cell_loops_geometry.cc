// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/cell_loops.h>

#include <deal.II/fe/fe_nothing.h>

#include <algorithm>
#include <map>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    using CellShape = BatchGeometry::Shape;

    /** Geometry at a point: ∂ξ_d/∂x_e, ratio of volumes, 1/x₁ of rings. */
    template <int dim>
    using PointGeometry = std::array<double, dim * dim + 2>;

    template <int dim>
    struct CellGeometry
    {
      CellShape                       shape;
      std::vector<PointGeometry<dim>> points; ///< one if the shape is simple
    };

    template <int dim>
    PointGeometry<dim>
    point_geometry(const Tensor<2, dim> &inverse_jacobian, const double volume)
    {
      PointGeometry<dim> of_point{};
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int e = 0; e < dim; ++e)
          of_point[d * dim + e] = inverse_jacobian[d][e];
      of_point[dim * dim] = volume;
      return of_point;
    }

    /** Geometry of a cell with straight edges that are parallel up to rounding;
     * otherwise without points. */
    template <int dim, typename Cell>
    CellGeometry<dim>
    simple_geometry(const Cell &cell)
    {
      const Point<dim> &origin = cell->vertex(0);
      Tensor<2, dim>    jacobian;
      double            size = 0., distance = 0.;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const Tensor<1, dim> edge = cell->vertex(1U << d) - origin;
          for (unsigned int e = 0; e < dim; ++e)
            jacobian[e][d] = edge[e];
          size = std::max(size, edge.norm());
        }
      double skewness = 0., deviation = 0.;
      for (const unsigned int v : cell->vertex_indices())
        {
          distance = std::max(distance, cell->vertex(v).norm());
          deviation =
            std::max(deviation,
                     (origin +
                      jacobian *
                        Tensor<1, dim>(GeometryInfo<dim>::unit_cell_vertex(v)) -
                      cell->vertex(v))
                       .norm());
        }
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int e = 0; e < dim; ++e)
          if (d != e)
            skewness = std::max(skewness, std::abs(jacobian[d][e]));

      const double rounding = 1e-14 * size + 4e-16 * distance;
      if (deviation > rounding)
        return {CellShape::other, {}};
      const bool is_brick = skewness <= rounding;
      return {is_brick ? CellShape::brick : CellShape::parallelepiped,
              {point_geometry<dim>(invert(jacobian), determinant(jacobian))}};
    }

    /** Collects the geometry of cells in batches. Simple shapes that are equal
     * up to rounding share their numbers. */
    template <int dim, typename Real>
    class BatchPacker
    {
    public:
      BatchPacker(const Space<dim>  &space,
                  const unsigned int n_lanes,
                  const double       unit)
        : rule(space.quadratures[0])
        , is_straight(
            dynamic_cast<const MappingQ<dim> &>(space.mapping).get_degree() ==
            1)
        , fe_values(space.mapping,
                    no_functions,
                    rule,
                    update_inverse_jacobians | update_jacobians |
                      (space.roles.has_axis ? update_quadrature_points
                                            : update_default))
        , n_lanes(n_lanes)
        , unit(unit)
        , volume_unit(std::pow(unit, space.measure_dimension()))
        , rings(space.roles.has_axis)
      {
      }

      void
      add_all(const CellLoops<dim> &loops)
      {
        loops.for_each_cell(
          [this](const auto &cell, const unsigned int) { add(cell); });
        finish_batch();
      }

      std::vector<BatchGeometry> batches;
      AlignedVector<Real>        values;

    private:
      void
      add(const typename Triangulation<dim>::cell_iterator &cell)
      {
        CellGeometry<dim> geometry{CellShape::other, {}};
        if (is_straight && !rings)
          geometry = simple_geometry<dim>(cell);
        if (geometry.shape == CellShape::other)
          {
            fe_values.reinit(cell);
            for (unsigned int q = 0; q < rule.size(); ++q)
              {
                geometry.points.push_back(point_geometry<dim>(
                  Tensor<2, dim>(fe_values.inverse_jacobian(q)),
                  determinant(Tensor<2, dim>(fe_values.jacobian(q)))));
                if (rings)
                  {
                    const double radius = fe_values.quadrature_point(q)[0];
                    geometry.points.back()[dim * dim] *= radius;
                    geometry.points.back()[dim * dim + 1] = 1. / radius;
                  }
              }
          }
        batch.push_back(std::move(geometry));
        if (batch.size() == n_lanes)
          finish_batch();
      }

      void
      finish_batch()
      {
        if (batch.empty())
          return;
        CellShape shape = CellShape::brick;
        for (const auto &cell : batch)
          shape = std::max(shape, cell.shape);
        while (batch.size() < n_lanes)
          batch.push_back(batch.front());
        numbers.clear();
        const unsigned int n = shape == CellShape::other ? rule.size() : 1;
        for (unsigned int q = 0; q < n; ++q)
          for (unsigned int k = 0; k <= dim * dim + (rings ? 1 : 0); ++k)
            if (shape != CellShape::brick || k == dim * dim ||
                k % (dim + 1) == 0)
              for (const auto &cell : batch)
                {
                  const auto &point =
                    cell.points[cell.points.size() == 1 ? 0 : q];
                  numbers.push_back(k == dim * dim ? point[k] / volume_unit
                                                   : point[k] * unit);
                }

        std::size_t start = values.size();
        if (shape != CellShape::other)
          {
            // Rounding of vertices changes equal cells by 1e-16 times the
            // number of cells across.
            const auto are_equal = [](const Real a, const Real b) {
              return std::abs(a - b) <= 1e-12 * std::abs(a);
            };
            std::size_t &latest =
              known.try_emplace({numbers.begin(), numbers.end()}, start)
                .first->second;
            if (latest == start || !std::equal(numbers.begin(),
                                               numbers.end(),
                                               values.begin() + latest,
                                               are_equal))
              latest = start;
            start = latest;
          }
        if (start == values.size())
          values.insert_back(numbers.begin(), numbers.end());
        batches.push_back({start, shape});
        batch.clear();
      }

      const Quadrature<dim> rule;
      const bool            is_straight; ///< all edges
      const FE_Nothing<dim> no_functions;
      FEValues<dim>         fe_values;
      const unsigned int    n_lanes;
      const double          unit, volume_unit;
      const bool            rings;

      std::vector<CellGeometry<dim>> batch;
      std::vector<Real>              numbers;

      /** Position of the latest numbers that are equal as floats: one candidate
       * for each batch, however many cells differ by less than floats show. */
      std::map<std::vector<float>, std::size_t> known;
    };
  } // namespace



  template <int dim>
  template <typename Real>
  std::unique_ptr<const typename CellLoops<dim>::template Geometry<Real>>
  CellLoops<dim>::make_geometry() const
  {
    auto geometry     = std::make_unique<Geometry<Real>>();
    geometry->kernels = cell_kernels<Real>(kind);
    BatchPacker<dim, Real> packer(space,
                                  geometry->kernels.n_lanes,
                                  std::is_same_v<Real, float> ? length_unit()
                                                              : 1.);
    packer.add_all(*this);
    geometry->of_batch = std::move(packer.batches);
    geometry->values   = std::move(packer.values);
    return geometry;
  }



#define INSTANTIATE(dim, Real)                                   \
  template std::unique_ptr<const CellLoops<dim>::Geometry<Real>> \
  CellLoops<dim>::make_geometry<Real>() const;

  INSTANTIATE(2, float)
  INSTANTIATE(2, double)
  INSTANTIATE(3, float)
  INSTANTIATE(3, double)
#undef INSTANTIATE
} // namespace Crevasse
