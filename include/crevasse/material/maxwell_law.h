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
   * reference [1]), as functions of place, time and temperature θ:
   *
   *     s  = k(t) K (e − f − Σ wᵢ rᵢ),
   *     sᵢ = k(t) wᵢ K (e − f − rᵢ),      ṙᵢ = η₀(t)⁻¹ Hᵢ sᵢ
   *
   * with the free strain f, such as χθ, the stiffness K (symmetric, positive
   * definite; its 33 row and column are zero in plane stress), the fluidities
   * Hᵢ (symmetric, positive semidefinite) and the fractions wᵢ; 1 − Σ wᵢ is an
   * elastic spring. One branch with w = 1 is the paper's body, none an elastic
   * one.
   *
   * Creep that is not linear is one branch, with the H of N = Hs/s, see
   * CreepLaw; where it hardens, CreepPoint tells what stands for r.
   */
  template <int dim>
  class MaxwellLaw
  {
  public:
    struct Branch
    {
      double                     fraction; ///< wᵢ
      Property<VoigtMatrix<dim>> fluidity; ///< Hᵢ, in 1/(stress × time)
    };

    /** A part of the strain that the body has without stress. */
    struct FreeStrain
    {
      Property<VoigtVector<dim>> value;      ///< with engineering shears
      bool                       is_thermal; ///< to be multiplied by θ
    };

    /** @throw SceneError if a matrix has not the rows of its dimension. */
    explicit MaxwellLaw(const MaterialParameters &parameters);

    /** K, in units of stress, without its factor k(t). */
    const Property<VoigtMatrix<dim>> stiffness;

    const std::vector<Branch> branches;

    /** The law of the one branch; null: the branches are linear. */
    const CreepLaw *const creep;

    bool
    hardens() const
    {
      return creep != nullptr && creep->hardens;
    }

    /** Constants of the creep law; without formulas: there is none. */
    const Property<CreepLaw::Constants> creep_constants;

    /** The parts of f. */
    std::vector<FreeStrain> free_strains;

    // k(t) and η₀(t). @throw SceneError if they are not positive.
    double
    stiffness_factor(const double t) const;
    double
    viscosity_factor(const double t) const;

    /** Whether stiffness and viscosity have no 33 row. */
    const bool plane_stress;

    /** Whether part of the stiffness does not creep: then there is no secular
     * flow. */
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
     * The τ of a body with H = (τK)⁻¹, one number in space and time; nothing
     * if it is another body.
     */
    std::optional<double> uniform_relaxation_time;

  private:
    Expression k;
    Expression eta_0;
  };
} // namespace Crevasse

#endif
