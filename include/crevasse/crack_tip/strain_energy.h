// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_strain_energy_h
#define crevasse_crack_tip_strain_energy_h

#include <crevasse/crack_tip/tip_region.h>
#include <crevasse/discretisation/material_field.h>


namespace Crevasse
{
  /**
   * The energy that the springs of the material have stored in the modelled
   * part of the body (in half of it above a crack), per thickness:
   *
   *     ½ ∫ s:(kK)⁻¹s  for one Maxwell body or an elastic one,
   *     ½ ∫ Σ wᵢ εᵢ:kK εᵢ,   εᵢ = (kK)⁻¹s + Σ wⱼrⱼ − rᵢ  for a chain,
   *
   * the spring of a chain being a branch with r = 0. It is less than what was
   * put in by what was dissipated.
   */
  class StrainEnergy
  {
  public:
    /** Collective. Both must outlive this object. */
    StrainEnergy(const MaterialField<2> &material, const PointGeometry &points);

    /** Collective. @param state the material of the instant. */
    double
    value(const MaterialState<2> &state,
          const Vector           &stress,
          const Vector           &viscous_strain) const;

  private:
    using Matrices = PointValues<VoigtMatrix<2>>;

    Matrices
    compliance_of(const MaterialState<2> &state) const;

    const PointGeometry          &points;
    const std::optional<Matrices> constant_compliance; ///< if it is constant
  };
} // namespace Crevasse

#endif
