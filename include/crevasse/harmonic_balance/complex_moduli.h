// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_harmonic_balance_complex_moduli_h
#define crevasse_harmonic_balance_complex_moduli_h

#include <crevasse/discretisation/material_field.h>

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

  /**
   * What stands for the stiffness where everything oscillates at one frequency
   * (model, §3), with κ = k/(η₀ z) and z = iω or what a time scheme makes of
   * it: each branch bears
   *
   *     sᵢ = k K*ᵢ (e − χθ),   K*ᵢ = (I + κ wᵢ K Hᵢ)⁻¹ wᵢ K
   *
   * and the spring what it always bears. AlgorithmicModuli are the same with a
   * real κ.
   */
  template <int dim>
  struct ComplexModuli
  {
    using Matrices = PointValues<ComplexVoigtMatrix<dim>>;

    ComplexModuli(const MaterialState<dim>  &material,
                  const std::complex<double> kappa,
                  const std::size_t          n_points);

    std::vector<Matrices> branches; ///< K*ᵢ
    Matrices              sum;      ///< with the spring
  };

  /** The c with Σ K*ᵢ = c K at all points, if there is one: with a relaxation
   * time that is the same everywhere, and where κ = 0. Collective. */
  template <int dim>
  std::optional<std::complex<double>>
  common_factor(const ComplexModuli<dim>            &moduli,
                const PointValues<VoigtMatrix<dim>> &stiffness,
                const std::size_t                    n_points,
                const MPI_Comm                       communicator);
} // namespace Crevasse

#endif
