// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_interface_tip_h
#define crevasse_crack_tip_interface_tip_h

#include <crevasse/crack_tip/auxiliary_field.h>
#include <crevasse/lip/contact_boundary.h>
#include <crevasse/material/plane_elasticity.h>
#include <crevasse/time/state.h>

namespace Crevasse
{
  /**
   * Fields at the tip of a crack on the straight interface of two isotropic
   * bodies (Williams 1959; Rice, J. Appl. Mech. 55, 1988). With the compliances
   * A = κ₁/μ₁ + 1/μ₂ and B = κ₂/μ₂ + 1/μ₁ of the bodies above (1) and below
   * (2), the potentials are Φ₁ = Ω₂ = F/A, Φ₂ = Ω₁ = F/B in
   *
   *     σ₂₂ − iσ₁₂ = Φ(z) + Ω(z̄) + (z − z̄) conj Φ′(z),
   *     2μ ∂(u₁ + iu₂)/∂X = κΦ(z) − Ω(z̄) − (z − z̄) conj Φ′(z).
   *
   * Open lips have F ~ z^(−½ − iε) with 2πε = ln A/B. The stress ahead is
   * σ₂₂ + iσ₁₂ = (K_I + iK_II) (r/l)^(iε) / √(2πr): K is that at the distance
   * l, the length of the crack. Lips that are closed without friction have
   * F ~ −i z^(−½) and K_I = 0 (Comninou, J. Appl. Mech. 44, 1977).
   */
  class InterfaceTip
  {
  public:
    using Sides = std::array<VoigtMatrix<2>, 2>; ///< above and below

    /** @param stiffness isotropic, of both sides. @param length l */
    InterfaceTip(const Sides &stiffness, const double length);

    /** The AuxiliaryField of the integral that gives K of a mode: that of the
     * intensity K²/G. As of AnisotropicTip::auxiliary(), its factors do not
     * depend on κ, and that of strain is divided by modulus().
     * @param closed whether it is that of closed lips. */
    AuxiliaryField
    auxiliary(const CrackTip         &tip,
              const CrackMode         mode,
              const dealii::Point<2> &local,
              const SquareWeight     &weight,
              const bool              closed) const;

    /** Strain caused by a stress in the plane on one side. */
    VoigtVector<2>
    strain(const VoigtVector<2> &stress, const bool is_below) const
    {
      return sides[is_below].strain(stress);
    }

    /** K²/G of any phase, open or closed: E' of equal bodies. */
    double
    modulus() const
    {
      return 4. * (1. / compliance[0] + 1. / compliance[1]);
    }

    /** Oscillating index ε. */
    double
    epsilon() const
    {
      return std::log(compliance[0] / compliance[1]) /
             (2. * dealii::numbers::PI);
    }

    const Sides                          stiffness;
    const double                         length; ///< length l
    const std::array<PlaneElasticity, 2> sides;
    const std::array<double, 2>          compliance; ///< A and B
  };



  /** Length of the part of the lips next to a tip that is closed at a node next
   * to the tip and from there on; 0 if none is. Collective. */
  double
  contact_zone(const ContactBoundary<2> &lip,
               const CrackTip           &tip,
               const State              &state);

  /** Contact forces without those within a distance from a tip. */
  ContactForces
  forces_beyond(const double              distance,
                const ContactBoundary<2> &lip,
                const CrackTip           &tip,
                const ContactForces      &forces);
} // namespace Crevasse

#endif
