// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/harmonic_balance/complex_stiffness.h>

#include <utility>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  ComplexVoigtMatrix<dim>
  complex_stiffness(const VoigtMatrix<dim>    &K,
                    const VoigtMatrix<dim>    &H,
                    const std::complex<double> kappa)
  {
    // By Gauss and Jordan; LAPACK is slow on matrices as small as these. The
    // eigenvalues of the matrix are 1 + κλ with λ ≥ 0, never near zero.
    constexpr unsigned int  n  = n_stress_components<dim>;
    const VoigtMatrix<dim>  KH = K * H;
    ComplexVoigtMatrix<dim> matrix, result;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        {
          matrix[i][j] = (i == j ? 1. : 0.) + kappa * KH[i][j];
          result[i][j] = K[i][j];
        }
    for (unsigned int k = 0; k < n; ++k)
      {
        unsigned int pivot = k;
        for (unsigned int i = k + 1; i < n; ++i)
          if (std::norm(matrix[i][k]) > std::norm(matrix[pivot][k]))
            pivot = i;
        std::swap(matrix[k], matrix[pivot]);
        std::swap(result[k], result[pivot]);
        const std::complex<double> inverse = 1. / matrix[k][k];
        matrix[k] *= inverse;
        result[k] *= inverse;
        for (unsigned int i = 0; i < n; ++i)
          if (const std::complex<double> factor = matrix[i][k];
              i != k && factor != 0.)
            {
              matrix[i] -= factor * matrix[k];
              result[i] -= factor * result[k];
            }
      }
    return 0.5 * (result + transpose(result));
  }



#define INSTANTIATE(dim)                                   \
  template ComplexVoigtMatrix<dim> complex_stiffness<dim>( \
    const VoigtMatrix<dim> &,                              \
    const VoigtMatrix<dim> &,                              \
    const std::complex<double>)

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
