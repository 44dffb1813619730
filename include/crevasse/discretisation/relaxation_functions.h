// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------
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
