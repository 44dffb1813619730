// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_harmonic_balance_complex_stiffness_h
#define crevasse_harmonic_balance_complex_stiffness_h

#include <crevasse/material/voigt.h>

#include <complex>

namespace Crevasse
{
  /** What oscillates at one frequency, as the factor of exp(iωt). */
  template <int dim>
  using ComplexVoigtVector =
    dealii::Tensor<1, n_stress_components<dim>, std::complex<double>>;

  template <int dim>
  using ComplexVoigtMatrix =
    dealii::Tensor<2, n_stress_components<dim>, std::complex<double>>;

  /** (I + κ K H)⁻¹ K, for two symmetric matrices, positive semidefinite, and a
   * κ whose real part is not negative: the complex modulus (model, §3) for
   * κ = 1/(iω). It is symmetric, also where K has no 33 row. */
  template <int dim>
  ComplexVoigtMatrix<dim>
  complex_stiffness(const VoigtMatrix<dim>    &K,
                    const VoigtMatrix<dim>    &H,
                    const std::complex<double> kappa);
} // namespace Crevasse

#endif
