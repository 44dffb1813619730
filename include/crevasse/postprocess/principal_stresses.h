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

  /** Principal stresses in ascending order, and rows of their directions: all
   * three, or with n = 2 those in the plane of the mesh. By LAPACK, for the
   * name that deal.II's eigenvectors() has in a library compiled by GCC is not
   * the one that Clang looks for, and its eigenvalues() loses half of the
   * digits where two are equal. */
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
