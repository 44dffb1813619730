// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_algorithmic_moduli_h
#define crevasse_discretisation_algorithmic_moduli_h

#include <crevasse/discretisation/material_field.h>

namespace Crevasse
{
  /** Values at the quadrature points for each branch of a material. */
  template <typename Value>
  struct BranchValues
  {
    std::vector<PointValues<Value>> branches;

    std::size_t
    memory_consumption() const
    {
      std::size_t bytes = 0;
      for (const PointValues<Value> &branch : branches)
        bytes += branch.memory_consumption();
      return bytes;
    }
  };

  /**
   * Algorithmic moduli, which replace the stiffness if the viscous strain is
   * implicit, rᵢ = r̂ᵢ + c ṙᵢ (model, §3): the stress of each branch is
   *
   *     sᵢ = k K̂ᵢ (e − χθ − r̂ᵢ),   K̂ᵢ = (I + κ wᵢ K Hᵢ)⁻¹ wᵢ K,   κ = c k/η₀
   *
   * and that of the spring stays. All moduli are symmetric, and their sum is
   * positive definite on the components that K knows.
   *
   * For oscillations at one frequency they are complex: κ = k/(η₀ z) with z =
   * iω or its approximation by a time scheme.
   */
  template <int dim, typename Number = double>
  struct AlgorithmicModuli : BranchValues<VoigtMatrix<dim, Number>>
  {
    AlgorithmicModuli(const MaterialState<dim> &material,
                      const Number              kappa,
                      const std::size_t         n_points)
      : sum(transform(*material.stiffness,
                      n_points,
                      [&material](const VoigtMatrix<dim> &K) {
                        return Number(material.spring) * K;
                      }))
    {
      for (unsigned int i = 0; i < material.fluidity.size(); ++i)
        {
          const double w = material.fractions[i];
          this->branches.push_back(combine(
            *material.stiffness,
            *material.fluidity[i],
            n_points,
            [w, kappa](const VoigtMatrix<dim> &K, const VoigtMatrix<dim> &H) {
              return w * relaxed_stiffness<dim>(K, H, kappa * w);
            }));
          sum = add(sum, this->branches.back(), n_points);
        }
    }

    std::size_t
    memory_consumption() const
    {
      return BranchValues<VoigtMatrix<dim, Number>>::memory_consumption() +
             sum.memory_consumption();
    }

    PointValues<VoigtMatrix<dim, Number>> sum; ///< branches and spring
  };

  /**
   * Functions by which the viscous strain of a material relaxes over a time c
   * at constant strain: φ₁(−c Lᵢ) and φ₂(−c Lᵢ) for each branch and point, with
   * the rates Lᵢ = k wᵢ/η₀ Hᵢ K. See decay_functions().
   */
  template <int dim>
  struct RelaxationFunctions : BranchValues<PhiFunctions<dim>>
  {
    /** Computes φ₁ and φ₂. @param kappa c k/η₀ */
    RelaxationFunctions(const MaterialState<dim> &material,
                        const double              kappa,
                        const std::size_t         n_points)
    {
      for (unsigned int i = 0; i < material.fluidity.size(); ++i)
        this->branches.push_back(
          combine(*material.fluidity[i],
                  *material.stiffness,
                  n_points,
                  [factor = kappa * material.fractions[i]](
                    const VoigtMatrix<dim> &H, const VoigtMatrix<dim> &K) {
                    return decay_functions<dim>(factor * (H * K));
                  }));
    }
  };
} // namespace Crevasse

#endif
