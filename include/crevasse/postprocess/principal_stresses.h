// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_principal_stresses_h
#define crevasse_postprocess_principal_stresses_h

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/lac/lapack_support.h>
#include <deal.II/lac/lapack_templates.h>

#include <array>

namespace Crevasse
{
  template <int n>
  using PrincipalStresses =
    std::pair<std::array<double, n>, std::array<double, n * n>>;

  /** Computes principal stresses in ascending order and their directions by
   * row: all three, or with n = 2 those in the plane of the mesh. LAPACK is
   * called because deal.II's eigenvectors(), compiled by GCC, has a name that
   * Clang does not find, and eigenvalues() loses half of the digits of double
   * eigenvalues. */
  template <int n>
  PrincipalStresses<n>
  principal_stresses(const dealii::SymmetricTensor<2, 3> &stress)
  {
    std::array<double, n>         values;
    std::array<double, n * n>     vectors;
    std::array<double, 16 * n>    work;
    const dealii::types::blas_int size = n, n_work = work.size();
    dealii::types::blas_int       info = 0;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        vectors[i * n + j] = stress[i][j];
    dealii::syev("V",
                 "U",
                 &size,
                 vectors.data(),
                 &size,
                 values.data(),
                 work.data(),
                 &n_work,
                 &info);
    AssertThrow(info == 0, dealii::LAPACKSupport::ExcErrorCode("syev", info));
    return {values, vectors};
  }
} // namespace Crevasse

#endif
