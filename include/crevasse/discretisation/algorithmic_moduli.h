// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_algorithmic_moduli_h
#define crevasse_discretisation_algorithmic_moduli_h

#include <crevasse/discretisation/material_field.h>

#include <vector>

namespace Crevasse
{
  /**
   * What stands for the stiffness where the viscous strain is implicit,
   * rᵢ = r̂ᵢ + c ṙᵢ (model, §3): each branch bears
   *
   *     sᵢ = k K̂ᵢ (e − χθ − r̂ᵢ),   K̂ᵢ = (I + κ wᵢ K Hᵢ)⁻¹ wᵢ K,   κ = c k/η₀
   *
   * and the spring what it always bears. All are symmetric, and their sum is
   * positive definite on the components that K knows.
   */
  template <int dim>
  struct AlgorithmicModuli
  {
    using Matrices = PointValues<VoigtMatrix<dim>>;

    AlgorithmicModuli(const MaterialState<dim> &material,
                      const double              kappa,
                      const std::size_t         n_points);

    std::vector<Matrices> branches; ///< K̂ᵢ
    Matrices              sum;      ///< with the spring

    std::size_t
    memory_consumption() const;
  };
} // namespace Crevasse

#endif
