// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Part of cell_kernels_lanes.h: include no other header, see CellKernels.

#include <crevasse/kernels/cell_kernels.h>
#include <crevasse/kernels/cell_kernels_lines.h>

namespace Crevasse
{
  namespace
  {
    /** Operations at the points of a batch of cells. */
    template <int  dim,
              int  n_points_1d,
              bool mean_volume,
              bool rings,
              typename Real>
    struct PointKernel
    {
      using V __attribute__((vector_size(CREVASSE_LANE_BYTES))) = Real;
      using Stored __attribute__((may_alias)) = V; ///< V in arrays of Real

      using Shape  = BatchGeometry::Shape;
      using Cells  = CellBatches<Real>;
      using Moduli = BatchModuli<Real>;

      static constexpr int n_lanes      = CREVASSE_LANE_BYTES / sizeof(Real);
      static constexpr int n_points     = power(n_points_1d, dim);
      static constexpr int n_components = dim == 2 ? 4 : 6;

      using Values    = V[dim][n_points];
      using Gradients = V[dim][dim][n_points]; ///< component, direction
      using Strains   = V[n_points][n_components];

      static constexpr int
      voigt(const int i, const int j)
      {
        return i == j ? i : 2 + i + j;
      }

      struct Weights
      {
        Real of_point[n_points] = {};

        constexpr Weights()
        {
          for (int point = 0; point < n_points; ++point)
            {
              double product = 1.;
              for (int d = 0, rest = point; d < dim; ++d, rest /= n_points_1d)
                product *= Gauss<n_points_1d>::weights[rest % n_points_1d];
              of_point[point] = product;
            }
        }
      };
      static constexpr Weights weights{};

      /** Geometry at points of a batch: ∂ξ_d/∂x_e, volume, inverse radius. */
      template <bool is_brick>
      struct Geometry
      {
        const Stored *of_cells;
        int           per_point;

        static constexpr int place_of_volume = is_brick ? dim : dim * dim;
        static constexpr int n_values = place_of_volume + (rings ? 2 : 1);

        V
        inverse(const int point, const int d, const int e) const
        {
          return of_cells[point * per_point + (is_brick ? d : d * dim + e)];
        }

        V
        volume(const int point) const
        {
          return weights.of_point[point] *
                 of_cells[point * per_point + place_of_volume];
        }

        V
        inverse_radius(const int point) const
        {
          return of_cells[point * per_point + n_values - 1];
        }
      };

      /** Calls @p f with the geometry of a batch. */
      template <typename Function>
      static inline void
      with_geometry(const Cells       &cells,
                    const unsigned int batch,
                    const Function    &f)
      {
        const BatchGeometry &of_batch = cells.geometries[batch];
        const auto *const    values   = reinterpret_cast<const Stored *>(
          cells.geometry_values + of_batch.start);
        // (Rings are no bricks.)
        if (of_batch.shape == Shape::brick)
          f(Geometry<true>{values, 0});
        else
          f(Geometry<false>{values,
                            of_batch.shape == Shape::other
                              ? Geometry<false>::n_values
                              : 0});
      }

      /** Replaces a third of the trace of strains or stresses at each point by
       * its mean over the cell. */
      template <typename Geometry>
      static void
      make_trace_constant(const Geometry &geometry, Strains &values)
      {
        V integral{}, volume{}, thirds[n_points];
        for (int q = 0; q < n_points; ++q)
          {
            const V of_point = geometry.volume(q);
            thirds[q] =
              Real(1. / 3.) * (values[q][0] + values[q][1] + values[q][2]);
            integral += thirds[q] * of_point;
            volume += of_point;
          }
        const V mean = integral / volume;
        for (int q = 0; q < n_points; ++q)
          for (int i = 0; i < 3; ++i)
            values[q][i] += mean - thirds[q];
      }

      /** Strains from gradients in the unit cell and, for rings, values. */
      template <bool is_brick>
      static void
      to_strains(const Geometry<is_brick> &geometry,
                 const Values             &values,
                 const Gradients          &gradients,
                 Strains                  &strains)
      {
        for (int q = 0; q < n_points; ++q)
          {
            V of_point[dim][dim];
            for (int c = 0; c < dim; ++c)
              for (int e = 0; e < dim; ++e)
                if constexpr (is_brick)
                  of_point[c][e] =
                    gradients[c][e][q] * geometry.inverse(q, e, e);
                else
                  {
                    of_point[c][e] =
                      gradients[c][0][q] * geometry.inverse(q, 0, e);
                    for (int d = 1; d < dim; ++d)
                      of_point[c][e] +=
                        gradients[c][d][q] * geometry.inverse(q, d, e);
                  }
            if constexpr (dim == 2)
              strains[q][2] =
                rings ? values[0][q] * geometry.inverse_radius(q) : V{};
            for (int i = 0; i < dim; ++i)
              {
                strains[q][i] = of_point[i][i];
                for (int j = i + 1; j < dim; ++j)
                  strains[q][voigt(i, j)] = of_point[i][j] + of_point[j][i];
              }
          }
        if constexpr (mean_volume)
          make_trace_constant(geometry, strains);
      }

      /** Transpose of to_strains(), times volumes; only rings have values. */
      template <bool is_brick>
      static void
      from_stresses(const Geometry<is_brick> &geometry,
                    Strains                  &stresses,
                    Values                   &values,
                    Gradients                &gradients)
      {
        if constexpr (mean_volume)
          make_trace_constant(geometry, stresses);
        for (int q = 0; q < n_points; ++q)
          {
            const V volume = geometry.volume(q);
            V       s[n_components];
            for (int i = 0; i < n_components; ++i)
              s[i] = volume * stresses[q][i];
            if constexpr (rings)
              {
                values[0][q] = s[2] * geometry.inverse_radius(q);
                values[1][q] = V{};
              }
            for (int c = 0; c < dim; ++c)
              for (int d = 0; d < dim; ++d)
                if constexpr (is_brick)
                  gradients[c][d][q] =
                    s[voigt(c, d)] * geometry.inverse(q, d, d);
                else
                  {
                    gradients[c][d][q] =
                      s[voigt(c, 0)] * geometry.inverse(q, d, 0);
                    for (int e = 1; e < dim; ++e)
                      gradients[c][d][q] +=
                        s[voigt(c, e)] * geometry.inverse(q, d, e);
                  }
          }
      }

      /** Multiplies strains by the moduli, in place: the result is stresses. */
      static void
      apply_moduli(const Moduli &moduli, const unsigned int batch, Strains &s)
      {
        const Real *K = moduli.values + batch * moduli.per_batch;
        for (int q = 0; q < n_points; ++q, K += moduli.per_point)
          {
            const auto *const k = reinterpret_cast<const Stored *>(K);
            if (moduli.is_isotropic)
              {
                const V trace    = s[q][0] + s[q][1] + s[q][2];
                const V pressure = k[0] * trace, twice_shear = k[1] + k[1];
                for (int i = 0; i < 3; ++i)
                  s[q][i] = twice_shear * s[q][i] + pressure;
                for (int i = 3; i < n_components; ++i)
                  s[q][i] *= k[1];
                continue;
              }
            V stress[n_components];
            for (int i = 0, l = 0; i < n_components; ++i, ++l)
              {
                stress[i] = k[l + i] * s[q][i];
                for (int j = 0; j < i; ++j, ++l)
                  {
                    stress[i] += k[l] * s[q][j];
                    stress[j] += k[l] * s[q][i];
                  }
              }
            for (int i = 0; i < n_components; ++i)
              s[q][i] = stress[i];
          }
      }
    };
  } // namespace
} // namespace Crevasse
