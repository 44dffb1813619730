// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Kernels of cell_kernels.h for registers of CREVASSE_LANE_BYTES bytes, a macro
// of the including file. Include no other header, not even of the standard
// library: see CellKernels.

#include <crevasse/kernels/cell_kernels.h>
#include <crevasse/kernels/cell_kernels_points.h>

namespace Crevasse
{
  namespace
  {
    template <int  dim,
              int  n,
              int  n_points_1d,
              bool mean_volume,
              typename Real,
              bool rings = false>
    struct Kernel : PointKernel<dim, n_points_1d, mean_volume, rings, Real>
    {
      using Points = PointKernel<dim, n_points_1d, mean_volume, rings, Real>;
      using Lines  = Line<n, n_points_1d, Real>;
      using Cells  = CellBatches<Real>;
      using Moduli = BatchModuli<Real>;
      using Points::n_components;
      using Points::n_lanes;
      using Points::n_points;
      using typename Points::Gradients;
      using typename Points::Stored;
      using typename Points::Strains;
      using typename Points::V;
      using typename Points::Values;

      static constexpr int n_nodes = power(n, dim);

      // Values at nodes use the first entries of Values, later overwritten.

      static void
      gather(const unsigned int *first_indices, const Real *v, Values &values)
      {
        for (int node = 0; node < n_nodes; ++node)
          for (int c = 0; c < dim; ++c)
            {
              V of_lanes;
              for (int lane = 0; lane < n_lanes; ++lane)
                of_lanes[lane] = v[first_indices[lane * n_nodes + node] + c];
              values[c][node] = of_lanes;
            }
      }

      static void
      scatter(const unsigned int *first_indices,
              const unsigned int  n_cells,
              const Values       &values,
              Real               *result)
      {
        const auto add = [&](const int lanes) {
          for (int node = 0; node < n_nodes; ++node)
            for (int lane = 0; lane < lanes; ++lane)
              for (int c = 0; c < dim; ++c)
                result[first_indices[lane * n_nodes + node] + c] +=
                  values[c][node][lane];
        };
        if (n_cells >= n_lanes)
          add(n_lanes);
        else
          add(n_cells);
      }

      /** Applies an operation to all lines along a direction, from n_in values
       * on each line to n_out, with @p stride between the values of a line.
       * Works in place. */
      template <int n_in, int n_out, int stride, bool adds, typename Operation>
      static inline void
      on_lines(const int n_blocks, const V *in, V *out)
      {
        for (int block = 0; block < n_blocks; ++block)
          for (int s = 0; s < stride; ++s)
            {
              const int k = n_out > n_in ? n_blocks - 1 - block : block;
              V         x[n_in], y[n_out];
              for (int i = 0; i < n_in; ++i)
                x[i] = in[(k * n_in + i) * stride + s];
              Operation::apply(x, y);
              for (int i = 0; i < n_out; ++i)
                if constexpr (adds)
                  out[(k * n_out + i) * stride + s] += y[i];
                else
                  out[(k * n_out + i) * stride + s] = y[i];
            }
      }

      /** Interpolates values from nodes to points, and computes gradients there
       * in the unit cell's coordinates. */
      static void
      evaluate(Values &values, Gradients &gradients)
      {
        constexpr int m = n_points_1d;
        for (int c = 0; c < dim; ++c)
          {
            V *const u = values[c];
            on_lines<n, m, 1, false, typename Lines::Interpolate>(
              power(n, dim - 1), u, u);
            on_lines<n, m, m, false, typename Lines::Interpolate>(
              power(n, dim - 2), u, u);
            if constexpr (dim == 3)
              on_lines<n, m, m * m, false, typename Lines::Interpolate>(1,
                                                                        u,
                                                                        u);

            auto &g = gradients[c];
            on_lines<m, m, 1, false, typename Lines::Differentiate>(
              power(m, dim - 1), u, g[0]);
            on_lines<m, m, m, false, typename Lines::Differentiate>(
              power(m, dim - 2), u, g[1]);
            if constexpr (dim == 3)
              on_lines<m, m, m * m, false, typename Lines::Differentiate>(1,
                                                                          u,
                                                                          g[2]);
          }
      }

      /** Transpose of evaluate(). Only rings use values at points. */
      static void
      integrate(const Gradients &gradients, Values &values)
      {
        constexpr int m = n_points_1d;
        for (int c = 0; c < dim; ++c)
          {
            V *const    u = values[c];
            const auto &g = gradients[c];
            on_lines<m, m, 1, rings, typename Lines::DifferentiateTranspose>(
              power(m, dim - 1), g[0], u);
            on_lines<m, m, m, true, typename Lines::DifferentiateTranspose>(
              power(m, dim - 2), g[1], u);
            if constexpr (dim == 3)
              {
                on_lines<m,
                         m,
                         m * m,
                         true,
                         typename Lines::DifferentiateTranspose>(1, g[2], u);
                on_lines<m,
                         n,
                         m * m,
                         false,
                         typename Lines::InterpolateTranspose>(1, u, u);
              }
            on_lines<m, n, m, false, typename Lines::InterpolateTranspose>(
              power(n, dim - 2), u, u);
            on_lines<m, n, 1, false, typename Lines::InterpolateTranspose>(
              power(n, dim - 1), u, u);
          }
      }

      static void
      multiply(const Cells  &cells,
               const Moduli &moduli,
               const Real   *v,
               Real         *result)
      {
        Values    values;
        Gradients gradients;
        Strains   at_points;
        for (unsigned int batch = 0; batch * n_lanes < cells.n_cells; ++batch)
          {
            const unsigned int        first = batch * n_lanes;
            const unsigned int *const indices =
              cells.first_indices + first * n_nodes;
            gather(indices, v, values);
            evaluate(values, gradients);
            Points::with_geometry(cells, batch, [&](const auto &geometry) {
              Points::to_strains(geometry, values, gradients, at_points);
              Points::apply_moduli(moduli, batch, at_points);
              Points::from_stresses(geometry, at_points, values, gradients);
            });
            integrate(gradients, values);
            scatter(indices, cells.n_cells - first, values, result);
          }
      }

      static void
      strains(const Cells &cells, const Real *v, Real *strains)
      {
        Values    values;
        Gradients gradients;
        gather(cells.first_indices, v, values);
        evaluate(values, gradients);
        Points::with_geometry(cells, 0, [&](const auto &geometry) {
          Strains at_points;
          Points::to_strains(geometry, values, gradients, at_points);
          for (int q = 0; q < n_points; ++q)
            for (int i = 0; i < n_components; ++i)
              reinterpret_cast<Stored *>(strains)[q * n_components + i] =
                at_points[q][i];
        });
      }

      static void
      add_transpose(const Cells &cells, const Real *stresses, Real *force)
      {
        Values    values;
        Gradients gradients;
        Points::with_geometry(cells, 0, [&](const auto &geometry) {
          Strains at_points;
          for (int q = 0; q < n_points; ++q)
            for (int i = 0; i < n_components; ++i)
              at_points[q][i] = reinterpret_cast<const Stored *>(
                stresses)[q * n_components + i];
          Points::from_stresses(geometry, at_points, values, gradients);
        });
        integrate(gradients, values);
        scatter(cells.first_indices, cells.n_cells, values, force);
      }

      static constexpr CellKernels<Real> kernels = {n_lanes,
                                                    &multiply,
                                                    &strains,
                                                    &add_transpose};
    };



    template <int dim, typename Real>
    CellKernels<Real>
    find_in(const CellKind &kind)
    {
      if constexpr (dim == 2)
        if (kind.rings)
          return kind.mean_volume ? Kernel<2, 2, 2, true, Real, true>::kernels
                 : kind.degree == 1
                   ? Kernel<2, 2, 2, false, Real, true>::kernels
                   : Kernel<2, 3, 3, false, Real, true>::kernels;
      if (kind.degree == 1 && kind.mean_volume)
        return Kernel<dim, 2, 2, true, Real>::kernels;
      if constexpr (dim == 2 && sizeof(Real) == sizeof(double))
        {
          // Elements with singular functions use only D and its transpose.
          if (kind.degree == 1 && kind.n_points == 3)
            return Kernel<dim, 2, 3, false, Real>::kernels;
          if (kind.degree == 2 && kind.n_points == 4)
            return Kernel<dim, 3, 4, false, Real>::kernels;
        }
      return kind.degree == 1 ? Kernel<dim, 2, 2, false, Real>::kernels
                              : Kernel<dim, 3, 3, false, Real>::kernels;
    }

    template <typename Real>
    CellKernels<Real>
    find(const CellKind &kind)
    {
      return kind.dim == 2 ? find_in<2, Real>(kind) : find_in<3, Real>(kind);
    }
  } // namespace

  template <>
  CellKernels<float>
  kernels_of_width<CREVASSE_LANE_BYTES>(const CellKind &kind)
  {
    return find<float>(kind);
  }

  template <>
  CellKernels<double>
  kernels_of_width<CREVASSE_LANE_BYTES>(const CellKind &kind)
  {
    return find<double>(kind);
  }
} // namespace Crevasse
