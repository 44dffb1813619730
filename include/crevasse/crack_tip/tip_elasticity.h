// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_tip_elasticity_h
#define crevasse_crack_tip_tip_elasticity_h

#include <crevasse/crack_tip/auxiliary_field.h>
#include <crevasse/crack_tip/growth_direction.h>
#include <crevasse/crack_tip/interface_tip.h>

#include <optional>

namespace Crevasse
{
  /**
   * Fields at a crack tip in an anisotropic body (Sih, Paris, Irwin, Int. J.
   * Fract. Mech. 1, 1965; Lekhnitskii). With the compliance aᵢⱼ in the plane,
   * X along the crack, and the roots μᵢ, Im μᵢ > 0, of
   *
   *     a₁₁ μ⁴ − 2 a₁₆ μ³ + (2 a₁₂ + a₆₆) μ² − 2 a₂₆ μ + a₂₂ = 0,
   *
   * the stress function is 2 Re Σ Fᵢ(zᵢ), zᵢ = X + μᵢ Y, and u = 2 Re Σ (pᵢ,
   * qᵢ) Fᵢ′ with pᵢ = a₁₁ μᵢ² + a₁₂ − a₁₆ μᵢ, qᵢ = a₁₂ μᵢ + a₂₂/μᵢ − a₂₆.
   */
  class AnisotropicTip
  {
  public:
    /** @param stiffness in the coordinates of the mesh. */
    AnisotropicTip(const VoigtMatrix<2> &stiffness, const CrackTip &tip);

    /** The AuxiliaryField of the integral that gives K of a mode: of the
     * intensities L⁻¹ e. Its factors do not depend on κ: f₁ = 0, and κ = 3.
     * The strain's factor τ is divided by modulus(). */
    AuxiliaryField
    auxiliary(const CrackTip         &tip,
              const CrackMode         mode,
              const dealii::Point<2> &local,
              const SquareWeight     &weight) const;

    /** Strain caused by a stress in the plane, in the mesh's coordinates. */
    VoigtVector<2>
    strain(const VoigtVector<2> &stress) const
    {
      return compliance * stress;
    }

    /** Energy release rate G = K·L K, K = (K_I, K_II). */
    double
    release_rate(const dealii::Tensor<1, 2> &K) const
    {
      return K * (release * K);
    }

    /** K²/G of mode I, for E'. */
    double
    modulus() const
    {
      return 1. / release[0][0];
    }

    /** Whether the body is the same on both sides of the crack's line. */
    bool
    is_symmetric() const
    {
      return std::abs(a[0][2]) + std::abs(a[1][2]) <= 1e-8 * a[0][0];
    }

  private:
    using Complex = std::complex<double>;
    using Pair    = std::array<Complex, 2>;

    /** Factors cᵢ of zᵢ^(−½)/√(2π) in Fᵢ″ of intensities. */
    Pair
    factors(const dealii::Tensor<1, 2> &K) const;

    const VoigtMatrix<2> compliance;
    dealii::Tensor<2, 3> a; ///< compliance aᵢⱼ, 1 = 11, 2 = 22, 6 = 12
    Pair                 mu, p, q;
    dealii::Tensor<2, 2> release; ///< Irwin's matrix L
  };

  /** Elasticity at a tip, isotropic, anisotropic, or of two isotropic bodies,
   * as the interaction integral needs it. */
  class TipElasticity
  {
  public:
    /** @param stiffness in the coordinates of the mesh. */
    TipElasticity(const VoigtMatrix<2> &stiffness, const CrackTip &tip)
      : stiffness(stiffness)
      , isotropic(stiffness)
    {
      if (!PlaneElasticity::is_isotropic(stiffness))
        anisotropic.emplace(stiffness, tip);
    }

    explicit TipElasticity(const InterfaceTip &interface)
      : stiffness(interface.stiffness[0])
      , isotropic(stiffness)
      , interface(interface)
    {
    }

    /** Whether G alone is equivalent to both modes, and no direction of growth
     * is known. */
    bool
    has_only_release_rate() const
    {
      return anisotropic || interface;
    }

    /** Whether another stiffness is the same up to rounding. */
    bool
    is_same_as(const TipElasticity &other) const
    {
      const auto are_same = [](const VoigtMatrix<2> &a,
                               const VoigtMatrix<2> &b) {
        return (a - b).norm() <= 1e-8 * a.norm();
      };
      return are_same(stiffness, other.stiffness) &&
             are_same(below(), other.below());
    }

    /** κ, or 3 for the factors of AnisotropicTip::auxiliary(). */
    double
    kappa() const
    {
      return has_only_release_rate() ? 3. : isotropic.kappa();
    }

    /** E', or K²/G of mode I. */
    double
    modulus() const
    {
      return anisotropic ? anisotropic->modulus()
             : interface ? interface->modulus()
                         : isotropic.modulus();
    }

    /** Strain caused by a stress. @param is_below of the side below the crack's
     * line. */
    VoigtVector<2>
    strain(const VoigtVector<2> &s, const bool is_below) const
    {
      return anisotropic ? anisotropic->strain(s)
             : interface ? interface->strain(s, is_below)
                         : isotropic.strain(s);
    }

    double
    release_rate(const double K_I, const double K_II) const
    {
      const dealii::Tensor<1, 2> K({K_I, K_II});
      return anisotropic ? anisotropic->release_rate(K)
                         : K.norm_square() / modulus();
    }

    /** K of mode I that is equivalent to both modes: that with the same hoop
     * stress or, in an anisotropic body and between two, with the same G. */
    double
    equivalent(const double K_I, const double K_II) const
    {
      return has_only_release_rate()
               ? std::sqrt(modulus() * release_rate(std::max(K_I, 0.), K_II))
               : GrowthDirection(K_I, K_II).intensity;
    }

    /** Whether the stress at the tip does not depend on how much the body has
     * crept with these fluidities above and below the crack: viscous strain is
     * then compatible. */
    bool
    leaves_stress(const VoigtMatrix<2> &above,
                  const VoigtMatrix<2> &of_below) const;

    /** Stiffness below the crack. */
    const VoigtMatrix<2> &
    below() const
    {
      return interface ? interface->stiffness[1] : stiffness;
    }

    VoigtMatrix<2>                stiffness; ///< above the crack
    PlaneElasticity               isotropic; ///< unless one of these is set
    std::optional<AnisotropicTip> anisotropic;
    std::optional<InterfaceTip>   interface;
  };
} // namespace Crevasse

#endif
