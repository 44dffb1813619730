// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_arc_field_h
#define crevasse_crack_tip_arc_field_h

#include <crevasse/crack_tip/interface_tip.h>

namespace Crevasse
{
  /**
   * Field of a unit intensity around the tip of a crack along a circle between
   * two isotropic bodies, by the continuation of Muskhelishvili's potentials
   * across it (England, J. Appl. Mech. 33, 1966): with the curvature k, z =
   * |k|Z + b, Z = X + iY, the tip b = −i sign k and the image ζ = 1/z̄,
   *
   *     2μ ∂U/∂z = κΦ − conj Φ,
   *     2μ ∂U/∂z̄ = (ζ − z) conj Φ′ − ζ² (Φ_e(ζ) + conj Φ),
   *
   * σ₁₁ + σ₂₂ = 4 Re Φ, σ₂₂ − σ₁₁ − 2iσ₁₂ = −4μ ∂U/∂z̄. With the compliances A
   * and B of InterfaceTip Φ = F/A above and F/B below, and Φ_e = −F/B and −F/A
   * at the image, on the other side; F = C Z^(−½ − iε) as there, with the
   * circle as its cut. Only the tip and the centre of the circle are singular.
   */
  class ArcField
  {
  public:
    /** Tip and interface must outlive the ArcField.
     * @param mode whose intensity is 1. */
    ArcField(const CrackTip     &tip,
             const InterfaceTip &interface,
             const CrackMode     mode);

    /** Gradient of the displacement and stress in the coordinates of the mesh.
     */
    struct Gradients
    {
      dealii::Tensor<2, 2> slopes, stress;
    };

    /** @param local the point (X, Y). */
    Gradients
    at(const dealii::Point<2> &local, const bool is_below) const;

  private:
    using Complex = std::complex<double>;

    Complex
    F(const Complex &Z, const bool is_below) const;

    const CrackTip     &tip;
    const InterfaceTip &interface;
    const Complex       C;
  };
} // namespace Crevasse

#endif
