// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_auxiliary_field_h
#define crevasse_crack_tip_auxiliary_field_h

#include <crevasse/grid/crack_tip.h>
#include <crevasse/material/voigt.h>

#include <cmath>
#include <complex>

namespace Crevasse
{
  /** Weight q = (1 − X²/R²)ⁿ (1 − Y²/R²)ⁿ of the interaction integral, the
   * product of a factor of X and a factor of Y. */
  struct SquareWeight
  {
    double radius; ///< half side R
    /** Exponent n: 2 if the square cuts no cell. 3 otherwise: with 2 the second
     * derivatives jump at its edge. 4 in space: with 3 the third derivatives
     * jump, which rules in cells do not integrate to four digits. */
    int exponent;

    /** One factor and its first two derivatives; 0 outside of the square. */
    std::array<double, 3>
    factor(const double x) const
    {
      const double s = x / radius, rest = 1. - s * s;
      if (std::abs(s) >= 1.)
        return {};
      const double last = std::pow(rest, exponent - 2);
      return {{last * rest * rest,
               -2. * exponent * s * last * rest / radius,
               2. * exponent * last * ((2. * exponent - 1.) * s * s - 1.) /
                 (radius * radius)}};
    }
  };

  /** Bueckner's field, the auxiliary field of the interaction integral: the
   * field of a unit K differentiated along the crack, with stress function φ^B
   * and 2μ u^B = κ Φ − rest; half of it around a tip with two lips. */
  struct BuecknerField
  {
    using Complex = std::complex<double>;

    /** Leaves the values open. */
    BuecknerField() = default;

    /** @param local the point (X, Y), not (0, 0). */
    explicit BuecknerField(const dealii::Point<2> &local,
                           const CrackMode         mode = CrackMode::opening,
                           const bool              two_lips = false);

    Complex Phi, rest;
    double  airy;            ///< stress function φ^B
    Complex along;           ///< gradient ∂φ^B/∂X + i ∂φ^B/∂Y
    double  mean;            ///< mean stress ½ (σ₁₁ + σ₂₂)
    Complex half_difference; ///< deviator ½ (σ₂₂ − σ₁₁) + i σ₁₂
  };

  /**
   * Factors of the InteractionIntegral at a point, from the auxiliary field
   * times the weight, in the coordinates of the mesh. N and E' w are (f₀ + κ
   * f₁) 4/(κ + 1). Halved where the tip has two lips: then the body on both
   * sides counts.
   */
  struct AuxiliaryField
  {
    /** Creates a zero field. */
    AuxiliaryField() = default;

    /** Computes the factors at a point.
     * @param local the point (X, Y), not (0, 0). */
    AuxiliaryField(const CrackTip         &tip,
                   const CrackMode         mode,
                   const dealii::Point<2> &local,
                   const SquareWeight     &weight)
      : AuxiliaryField(tip,
                       local,
                       weight,
                       BuecknerField(local, mode, tip.two_lips))
    {
    }

    /** Computes the factors at a point from a field. */
    AuxiliaryField(const CrackTip         &tip,
                   const dealii::Point<2> &local,
                   const SquareWeight     &weight,
                   const BuecknerField    &field);

    /** Adds another field times a factor. */
    void
    add(const double factor, const AuxiliaryField &other);

    std::array<VoigtVector<2>, 2>       of_stress; ///< N, with shears twofold
    std::array<dealii::Tensor<1, 2>, 2> of_force;  ///< factor E' w of force
    VoigtVector<2>                      of_strain; ///< factor τ of strain
  };

  /** Converts a symmetric tensor (11, 22, 12) in the coordinates of the tip to
   * a vector in the coordinates of the mesh.
   * @param of_shear factor of the component 12. */
  VoigtVector<2>
  to_mesh(const CrackTip              &tip,
          const std::array<double, 3> &tensor,
          const double                 of_shear);
} // namespace Crevasse

#endif
