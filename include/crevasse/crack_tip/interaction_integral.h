// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_interaction_integral_h
#define crevasse_crack_tip_interaction_integral_h

#include <crevasse/crack_tip/tip_region.h>
#include <crevasse/model/body.h>

#include <vector>

namespace Crevasse
{
  /** K_I = k·v + l·g, for a vector v of the nodes and the contact forces g. */
  struct IntensityFunctional
  {
    Vector              of_vector;         ///< k
    std::vector<double> of_contact_forces; ///< l, for local nodes of the lip

    /** K_I. Collective. */
    double
    value(const Vector &v, const std::vector<double> &contact_forces) const;
  };

  /**
   * The stress intensity factor K_I as a linear function of an elastic
   * displacement u and of the contact forces g, by the interaction integral
   * (Yau, Wang, Corten, J. Appl. Mech. 47, 1980) of the half body above the
   * crack,
   *
   *     I = ∫ [σ_ij ∂u^a_i/∂X + σ^a_ij ∂u_i/∂X − σ_kl ε^a_kl δ_1j] ∂q/∂x_j dA
   *         − ∫_lip t_i ∂u^a_i/∂X q ds,              K_I = E'/2 · 2 I.
   *
   * u^a is the first term of Williams' series with K_I = 1. The factor 2 is the
   * other half of the body: the energy that a crack releases is that of both.
   * The weight is q = (1 − X²/R²)² (1 − Y²/R²)² in the square |X| ≤ R, 0 ≤ Y ≤
   * R, and its gradient vanishes at the tip and where q ends. On the lip the
   * contact pressure p leaves the term ∫ 2 p q / √(2πr) ds.
   *
   * q is not interpolated: it is smooth on any mesh, hanging nodes or not, and
   * so the functional differs from that of the continuous body by nothing but
   * the quadrature. By Betti's theorem its error is then the square of that of
   * the energy norm's.
   *
   * u must be an elastic displacement under tractions; what creeps has
   * gradients of its own.
   *
   * Collective. @param radius R, with nothing but lip and plane of symmetry in
   * the square: see TipRegion::largest_radius().
   */
  IntensityFunctional
  interaction_integral(const Body<2>   &body,
                       const TipRegion &region,
                       const double     radius);

  /**
   * What K_I loads and contact forces cause in an elastic body (Bueckner's
   * weight function, of the discretised body): with the displacement u of A u =
   * F + Lᵀ g, K_I = k·u + l·g, by the interaction integral or by the
   * coefficient of a singular function (l = 0), is
   *
   *     K_I = z·F + Σ (L z + l)_i g_i,       A z = k.
   *
   * One solve serves all instants. A factor of A leaves K_I as it is.
   *
   * @param influence z
   * @param bounds those of the contact forces, the nodes of the lip first.
   * @param of_lip l, for the nodes of the lip. */
  IntensityFunctional
  weight_function(Vector                   &&influence,
                  const UnilateralBounds    &bounds,
                  const std::vector<double> &of_lip);
} // namespace Crevasse

#endif
