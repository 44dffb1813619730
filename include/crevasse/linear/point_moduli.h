// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_point_moduli_h
#define crevasse_linear_point_moduli_h

#include <crevasse/material/voigt_matrix.h>

#include <array>
#include <cmath>

namespace Crevasse
{
  // Storage of K at a quadrature point in few numbers, for CellKernels.

  /** Isotropic moduli: six products per point instead of 36. */
  template <int dim>
  struct IsotropicModuli
  {
    static constexpr unsigned int n_values = 2;

    /** Lamé's constants λ and μ. */
    std::array<double, n_values> values;

    explicit IsotropicModuli(const VoigtMatrix<dim> &K)
      : values{{K[0][1], K[3][3]}}
    {
    }

    /** Whether K is isotropic up to rounding.
     *
     * @param with_out_of_plane Whether strain and stress of the third direction
     * count in the plane. */
    static bool
    represents(const VoigtMatrix<dim> &K, const bool with_out_of_plane)
    {
      const auto [lambda, mu]   = IsotropicModuli(K).values;
      constexpr double rounding = 1e-14;
      for (unsigned int i = 0; i < n_stress_components<dim>; ++i)
        for (unsigned int j = 0; j < n_stress_components<dim>; ++j)
          {
            const double expected = (i < 3 && j < 3 ? lambda : 0.) +
                                    (i == j ? (i < 3 ? 2. * mu : mu) : 0.);
            if (std::abs(expected - K[i][j]) > rounding * std::abs(K[0][0]) &&
                (dim == 3 || with_out_of_plane || (i != 2 && j != 2)))
              return false;
          }
      return true;
    }
  };



  /** Moduli of any symmetric K. */
  template <int dim>
  struct GeneralModuli
  {
    static constexpr unsigned int n_values =
      n_stress_components<dim> * (n_stress_components<dim> + 1) / 2;

    /** Lower triangle of K, row by row. */
    std::array<double, n_values> values;

    explicit GeneralModuli(const VoigtMatrix<dim> &K)
    {
      for (unsigned int i = 0, k = 0; i < n_stress_components<dim>; ++i)
        for (unsigned int j = 0; j <= i; ++j)
          values[k++] = K[i][j];
    }
  };
} // namespace Crevasse

#endif
