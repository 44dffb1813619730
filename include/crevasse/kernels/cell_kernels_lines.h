// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Part of cell_kernels_lanes.h: include no other header, see CellKernels.

namespace Crevasse
{
  namespace
  {
    constexpr int
    power(const int base, const int exponent)
    {
      return exponent == 0 ? 1 : base * power(base, exponent - 1);
    }

    /** Points and weights of Gauss's rule on [0,1]. */
    template <int n>
    struct Gauss;
    template <>
    struct Gauss<2>
    {
      static constexpr double points[]  = {.21132486540518711775,
                                           .78867513459481288225};
      static constexpr double weights[] = {.5, .5};
    };
    template <>
    struct Gauss<3>
    {
      static constexpr double points[]  = {.11270166537925831148,
                                           .5,
                                           .88729833462074168852};
      static constexpr double weights[] = {5. / 18., 8. / 18., 5. / 18.};
    };
    template <>
    struct Gauss<4>
    {
      static constexpr double points[]  = {.06943184420297371239,
                                           .33000947820757186760,
                                           .66999052179242813240,
                                           .93056815579702628761};
      static constexpr double weights[] = {.17392742256872692869,
                                           .32607257743127307131,
                                           .32607257743127307131,
                                           .17392742256872692869};
    };



    /** Values at Gauss's points of the Lagrange polynomials of n equidistant
     * nodes in [0,1], and derivatives of those whose nodes are these points. */
    template <int n, int n_points>
    struct Basis
    {
      double values[n_points][n]             = {};
      double derivatives[n_points][n_points] = {};

      constexpr Basis()
      {
        const auto &x = Gauss<n_points>::points;
        for (int q = 0; q < n_points; ++q)
          {
            for (int i = 0; i < n; ++i)
              {
                values[q][i] = 1.;
                for (int j = 0; j < n; ++j)
                  if (j != i)
                    values[q][i] *= ((n - 1) * x[q] - j) / (i - j);
              }
            for (int i = 0; i < n_points; ++i)
              for (int k = 0; k < n_points; ++k)
                if (k != i)
                  {
                    double term = 1. / (x[i] - x[k]);
                    for (int j = 0; j < n_points; ++j)
                      if (j != i && j != k)
                        term *= (x[q] - x[j]) / (x[i] - x[j]);
                    derivatives[q][i] += term;
                  }
          }
      }
    };



    /** Matrices of interpolation and differentiation along a line of nodes or
     * points, and their transposes. For two and three points they use sums and
     * differences of opposite values, which halves the number of products. */
    template <int n, int n_points, typename Real>
    struct Line
    {
      // (Template arguments lose the attribute, so V is not one.)
      using V __attribute__((vector_size(CREVASSE_LANE_BYTES))) = Real;

      static constexpr Basis<n, n_points> basis{};

      /** Interpolation from nodes to points. */
      struct Interpolate
      {
        static inline void
        apply(const V *x, V *y)
        {
          if constexpr (n == 3 && n_points == 3)
            {
              const V even = Real(.3) * (x[0] + x[2]) + Real(.4) * x[1];
              const V odd  = Real(basis.values[2][2] - .3) * (x[2] - x[0]);
              y[0]         = even - odd;
              y[1]         = x[1];
              y[2]         = even + odd;
            }
          else
            for (int q = 0; q < n_points; ++q)
              {
                y[q] = Real(basis.values[q][0]) * x[0];
                for (int i = 1; i < n; ++i)
                  y[q] += Real(basis.values[q][i]) * x[i];
              }
        }
      };

      struct InterpolateTranspose
      {
        static inline void
        apply(const V *y, V *x)
        {
          if constexpr (n == 3 && n_points == 3)
            {
              const V sum  = y[0] + y[2];
              const V even = Real(.3) * sum;
              const V odd  = Real(basis.values[2][2] - .3) * (y[2] - y[0]);
              x[0]         = even - odd;
              x[1]         = y[1] + Real(.4) * sum;
              x[2]         = even + odd;
            }
          else
            for (int i = 0; i < n; ++i)
              {
                x[i] = Real(basis.values[0][i]) * y[0];
                for (int q = 1; q < n_points; ++q)
                  x[i] += Real(basis.values[q][i]) * y[q];
              }
        }
      };

      /** Derivatives at points from values at points. */
      struct Differentiate
      {
        static inline void
        apply(const V *x, V *y)
        {
          constexpr auto &D = basis.derivatives;
          if constexpr (n_points == 2)
            y[0] = y[1] = Real(D[0][1]) * (x[1] - x[0]);
          else if constexpr (n_points == 3)
            {
              // Derivatives of even quadratic polynomials are odd.
              const V odd = Real(D[1][2]) * (x[2] - x[0]);
              const V even =
                Real(-.5 * D[2][1]) * ((x[0] - x[1]) + (x[2] - x[1]));
              y[0] = odd - even;
              y[1] = odd;
              y[2] = odd + even;
            }
          else
            for (int q = 0; q < n_points; ++q)
              {
                y[q] = Real(D[q][0]) * x[0];
                for (int i = 1; i < n_points; ++i)
                  y[q] += Real(D[q][i]) * x[i];
              }
        }
      };

      struct DifferentiateTranspose
      {
        static inline void
        apply(const V *y, V *x)
        {
          constexpr auto &D = basis.derivatives;
          if constexpr (n_points == 2)
            {
              x[1] = Real(D[0][1]) * (y[0] + y[1]);
              x[0] = -x[1];
            }
          else if constexpr (n_points == 3)
            {
              const V odd  = Real(D[1][2]) * (y[0] + y[1] + y[2]);
              const V even = Real(-.5 * D[2][1]) * (y[2] - y[0]);
              x[0]         = even - odd;
              x[1]         = Real(-2.) * even;
              x[2]         = even + odd;
            }
          else
            for (int i = 0; i < n_points; ++i)
              {
                x[i] = Real(D[0][i]) * y[0];
                for (int q = 1; q < n_points; ++q)
                  x[i] += Real(D[q][i]) * y[q];
              }
        }
      };
    };
  } // namespace
} // namespace Crevasse
