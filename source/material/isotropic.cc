// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/material/isotropic.h>

#include <cmath>

namespace Crevasse
{
  template <int dim>
  VoigtMatrix<dim>
  isotropic_stiffness(const double young_modulus,
                      const double poisson_ratio,
                      const bool   plane_stress)
  {
    const double E = young_modulus, nu = poisson_ratio;
    const double mu = E / (2. * (1. + nu));
    const double lambda =
      plane_stress ? E * nu / (1. - nu * nu) : 2. * mu * nu / (1. - 2. * nu);

    VoigtMatrix<dim>   K;
    const unsigned int n_normal = plane_stress ? 2 : 3;
    for (unsigned int i = 0; i < n_normal; ++i)
      for (unsigned int j = 0; j < n_normal; ++j)
        K[i][j] = lambda + (i == j ? 2. * mu : 0.);
    for (unsigned int i = 3; i < n_stress_components<dim>; ++i)
      K[i][i] = mu;
    return K;
  }



  template <int dim>
  VoigtMatrix<dim>
  isotropic_compliance(const double young_modulus, const double poisson_ratio)
  {
    VoigtMatrix<dim> compliance;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        compliance[i][j] = (i == j ? 1. : -poisson_ratio) / young_modulus;
    for (unsigned int i = 3; i < n_stress_components<dim>; ++i)
      compliance[i][i] = 2. * (1. + poisson_ratio) / young_modulus;
    return compliance;
  }



  template <int dim>
  bool
  is_isotropic(const VoigtMatrix<dim> &matrix)
  {
    const double rounding = 1e-14 * std::abs(matrix[0][0]);
    const auto   equal    = [rounding](const double a, const double b) {
      return std::abs(a - b) <= rounding;
    };
    const bool is_plane_stress  = dim == 2 && matrix[2].norm_square() == 0.;
    const unsigned int n_normal = is_plane_stress ? 2 : 3;
    const double       shear    = matrix[3][3];
    for (unsigned int i = 0; i < n_stress_components<dim>; ++i)
      for (unsigned int j = 0; j < n_stress_components<dim>; ++j)
        {
          const bool   normal = i < n_normal && j < n_normal;
          const bool   absent = is_plane_stress && (i == 2 || j == 2);
          const double expected =
            absent ? 0.
                   : (normal ? (i == j ? matrix[0][0] : matrix[0][1])
                             : (i == j ? shear : 0.));
          if (!equal(matrix[i][j], expected))
            return false;
        }
    return true;
  }



#define INSTANTIATE(dim)                                             \
  template VoigtMatrix<dim> isotropic_stiffness<dim>(const double,   \
                                                     const double,   \
                                                     const bool);    \
  template VoigtMatrix<dim> isotropic_compliance<dim>(const double,  \
                                                      const double); \
  template bool             is_isotropic<dim>(const VoigtMatrix<dim> &)

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
