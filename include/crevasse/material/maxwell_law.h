// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_material_maxwell_law_h
#define crevasse_material_maxwell_law_h

#include <crevasse/material/property.h>
#include <crevasse/material/voigt.h>
#include <crevasse/parameters/parameters.h>

namespace Crevasse
{
  /**
   * Stress and creep of Maxwell bodies in parallel (paper, §3 and its
   * reference [1]), as functions of position, time and temperature θ:
   *
   *     s  = k(t) K (e − f − Σ wᵢ rᵢ),
   *     sᵢ = k(t) wᵢ K (e − f − rᵢ),      ṙᵢ = η₀(t)⁻¹ Hᵢ sᵢ
   *
   * with the free strain f, such as χθ, the stiffness K (symmetric, positive
   * definite; its 33 row and column are zero in plane stress), the fluidities
   * Hᵢ (symmetric, positive semidefinite) and the fractions wᵢ; an elastic
   * spring has 1 − Σ wᵢ. The paper's body has one branch with w = 1, an elastic
   * body none.
   *
   * Nonlinear creep has one branch, with the H of N = Hs/s (see CreepLaw); with
   * hardening, the state of CreepPoint replaces r.
   */
  template <int dim>
  class MaxwellLaw
  {
  public:
    struct Branch
    {
      double                     fraction; ///< fraction wᵢ
      Property<VoigtMatrix<dim>> fluidity; ///< Hᵢ, in 1/(stress × time)
    };

    /** Part of the free strain f. */
    struct FreeStrain
    {
      Property<VoigtVector<dim>> value;      ///< with engineering shears
      bool                       is_thermal; ///< whether θ causes it
    };

    /** @throw SceneError if the size of a matrix is wrong. */
    explicit MaxwellLaw(const MaterialParameters &parameters);

    /** Stiffness K, in units of stress, without its factor k(t). */
    const Property<VoigtMatrix<dim>> stiffness;

    const std::vector<Branch> branches;

    /** Creep law of the single branch; null if the branches are linear. */
    const CreepLaw *const creep;

    bool
    hardens() const
    {
      return creep != nullptr && creep->hardens;
    }

    /** Constants of the creep law; without formulas if there is no law. */
    const Property<CreepLaw::Constants> creep_constants;

    /** Parts of the free strain f. */
    std::vector<FreeStrain> free_strains;

    /** Temperature from which coefficients of thermal expansion are means; no
     * value: that without strain. */
    const std::optional<double> mean_expansion_from;

    // Factors k(t) and η₀(t). @throw SceneError if not positive.
    double
    stiffness_factor(const double t) const;
    double
    viscosity_factor(const double t) const;

    /** Whether row and column 33 of stiffness and viscosity are zero. */
    const bool plane_stress;

    /** Whether there is an elastic spring, which excludes secular flow. */
    bool
    has_spring() const
    {
      double creeping = 0.;
      for (const Branch &branch : branches)
        creeping += branch.fraction;
      constexpr double rounding = 1e-12;
      return creeping < 1. - rounding;
    }

    /**
     * Relaxation time τ if H = (τK)⁻¹ with a constant τ; otherwise no value.
     */
    std::optional<double> uniform_relaxation_time;

  private:
    Expression k;
    Expression eta_0;
  };
} // namespace Crevasse

#endif
