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
  /** The weight q = (1 − X²/R²)ⁿ (1 − Y²/R²)ⁿ of the interaction integral, the
   * product of a factor of X and one of Y. */
  struct SquareWeight
  {
    double radius; ///< R
    /** n = 2 where the square cuts no cell. 3 else: with 2 the second
     * derivatives jump where it ends. 4 in space: with 3 the third ones jump,
     * which rules in cells do not integrate to four digits. */
    int exponent;

    /** A factor and its first two derivatives; 0 outside of the square. */
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

  /** The auxiliary field of the interaction integral: that of a unit K,
   * differentiated along the crack, Bueckner's, with the stress function φ^B
   * and 2μ u^B = κ Φ − rest; half of it around a tip with two lips. */
  struct BuecknerField
  {
    using Complex = std::complex<double>;

    /** @param local (X, Y), not (0, 0). */
    explicit BuecknerField(const dealii::Point<2> &local,
                           const CrackMode         mode = CrackMode::opening,
                           const bool              two_lips = false);

    Complex Phi, rest;
    double  airy;            ///< φ^B
    Complex along;           ///< ∂φ^B/∂X + i ∂φ^B/∂Y
    double  mean;            ///< ½ (σ₁₁ + σ₂₂)
    Complex half_difference; ///< ½ (σ₂₂ − σ₁₁) + i σ₁₂
  };

  /**
   * What the interaction integral multiplies at a point, from the auxiliary
   * field times the weight: see InteractionIntegral. N and E' w are
   * (f₀ + κ f₁) 4/(κ + 1); all is in the coordinates of the mesh. Half of it
   * where the tip has two lips: the body on both sides counts then.
   */
  struct AuxiliaryField
  {
    /** Nothing anywhere. */
    AuxiliaryField() = default;

    /** @param point not the tip itself. */
    AuxiliaryField(const CrackTip         &tip,
                   const CrackMode         mode,
                   const dealii::Point<2> &point,
                   const SquareWeight     &weight);

    /** Adds a field times a factor. */
    void
    add(const double factor, const AuxiliaryField &other);

    std::array<VoigtVector<2>, 2>       of_stress; ///< N, with shears twofold
    std::array<dealii::Tensor<1, 2>, 2> of_force;  ///< E' w
    VoigtVector<2>                      of_strain; ///< τ
  };
} // namespace Crevasse

#endif
