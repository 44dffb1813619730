// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_relaxation_functions_h
#define crevasse_discretisation_relaxation_functions_h

#include <crevasse/discretisation/material_field.h>

#include <array>
#include <vector>

namespace Crevasse
{
  /**
   * How the viscous strain of a material relaxes over a time c where the strain
   * is held: φ₁(−c Lᵢ) and φ₂(−c Lᵢ) for each branch and point, with the rates
   * Lᵢ = k wᵢ/η₀ Hᵢ K. See decay_functions().
   */
  template <int dim>
  struct RelaxationFunctions
  {
    using Matrices = PointValues<VoigtMatrix<dim>>;

    /** @param kappa c k/η₀ */
    RelaxationFunctions(const MaterialState<dim> &material,
                        const double              kappa,
                        const std::size_t         n_points);

    /** φ₁ and φ₂, by branch. */
    std::array<std::vector<Matrices>, 2> phi;

    std::size_t
    memory_consumption() const;
  };
} // namespace Crevasse

#endif
