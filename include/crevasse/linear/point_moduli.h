// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_point_moduli_h
#define crevasse_linear_point_moduli_h

#include <crevasse/material/voigt_matrix.h>

#include <array>
#include <cmath>

namespace Crevasse
{
  /** s = K e at a quadrature point, with K in as few numbers as it has. @p
   * Values may hold numbers of one point, or of several in the lanes of a
   * vectorised type. Six products instead of 36 for the isotropic K. */
  template <int dim>
  struct IsotropicModuli
  {
    static constexpr unsigned int n_components = n_stress_components<dim>;
    static constexpr unsigned int n_normal     = 3; ///< then shear, engineering
    static constexpr unsigned int n_values     = 2;

    /** Lamé's constants. */
    std::array<double, n_values> values;

    explicit IsotropicModuli(const VoigtMatrix<dim> &K)
      : values{{K[0][1], K[n_normal][n_normal]}}
    {
    }

    /** Whether K is isotropic but for rounding.
     *
     * @param with_out_of_plane whether in the plane the strain and stress of
     * the third direction count. */
    static bool
    represents(const VoigtMatrix<dim> &K, const bool with_out_of_plane)
    {
      const IsotropicModuli moduli(K);
      constexpr double      rounding = 1e-14;
      for (unsigned int j = 0; j < n_components; ++j)
        {
          std::array<double, n_components> strain{}, stress{};
          strain[j] = 1.;
          multiply(moduli.values, strain, stress);
          for (unsigned int i = 0; i < n_components; ++i)
            if (std::abs(stress[i] - K[i][j]) > rounding * std::abs(K[0][0]) &&
                (dim == 3 || with_out_of_plane || (i != 2 && j != 2)))
              return false;
        }
      return true;
    }

    template <typename Values, typename Number>
    static void
    multiply(const Values                           &values,
             const std::array<Number, n_components> &strain,
             std::array<Number, n_components>       &stress)
    {
      const auto   shear     = values[1];
      const Number of_volume = values[0] * (strain[0] + strain[1] + strain[2]);
      for (unsigned int i = 0; i < n_normal; ++i)
        stress[i] = 2. * shear * strain[i] + of_volume;
      for (unsigned int i = n_normal; i < n_components; ++i)
        stress[i] = shear * strain[i];
    }
  };



  /** Any symmetric K. */
  template <int dim>
  struct GeneralModuli
  {
    static constexpr unsigned int n_components = n_stress_components<dim>;
    static constexpr unsigned int n_values =
      n_components * (n_components + 1) / 2;

    /** The lower triangle, row by row. */
    std::array<double, n_values> values;

    explicit GeneralModuli(const VoigtMatrix<dim> &K)
    {
      for (unsigned int i = 0, k = 0; i < n_components; ++i)
        for (unsigned int j = 0; j <= i; ++j)
          values[k++] = K[i][j];
    }

    template <typename Values, typename Number>
    static void
    multiply(const Values                           &values,
             const std::array<Number, n_components> &strain,
             std::array<Number, n_components>       &stress)
    {
      for (unsigned int i = 0, k = 0; i < n_components; ++i, ++k)
        {
          stress[i] = values[k + i] * strain[i];
          for (unsigned int j = 0; j < i; ++j, ++k)
            {
              stress[i] += values[k] * strain[j];
              stress[j] += values[k] * strain[i];
            }
        }
    }
  };
} // namespace Crevasse

#endif
