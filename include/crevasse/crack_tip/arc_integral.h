// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_arc_integral_h
#define crevasse_crack_tip_arc_integral_h

#include <crevasse/crack_tip/arc_field.h>
#include <crevasse/crack_tip/tip_region.h>
#include <crevasse/model/body.h>
#include <crevasse/time/observer.h>

namespace Crevasse
{
  /**
   * Computes G and K at the tip of a crack on an arc of a circle between two
   * isotropic elastic bodies, by Eshelby's tensor (Eshelby, J. Elasticity 5,
   * 1975; Shih, Asaro, J. Appl. Mech. 55, 1988):
   *
   *     P_kj = σ_ij u_i,k − W δ_kj,   V = q (1 − kY, kX),
   *
   *     G = ∫ (P_kj V_k,j − b·u,_V) dA − ∫_lips k q p [u_t] ds.
   *
   * V turns the body about the centre (0, 1/k) of the circle, with the weight q
   * of a square around the tip. It is tangential to the interface and the lips,
   * so that what jumps there does not enter: of the tractions of lips that
   * touch, by the pressure p, only what their curvature makes of the jump [u_t]
   * of the displacement along them. W is ½ σ:S σ, with the compliance S in the
   * plane: uniform thermal strain of each body adds a constant, whose integral
   * vanishes.
   *
   * G of two fields together, less G of each, is 2 Re(K_1 conj K_2)/M, M =
   * |K|²/G. With exact fields w, s of unit intensities (ArcField) this is
   *
   *     ∫ ((σ_ij w_i,k + s_ij u_i,k − σ:∇w δ_kj) V_k,j − b·w,_V) dA
   *       − ∫_lips q p n·[w,_s] ds
   *
   * and gives the phase of K; its size is that of G. Without the pressure in a
   * small zone of contact at the tip, K is that of the field around the zone.
   * Where a larger zone is closed K_I = 0, and K_II has the sign of the slip.
   */
  class ArcIntegral
  {
  public:
    /** Collective. The first five arguments must outlive the ArcIntegral.
     * @param sizes half the sides of two squares, the larger one first.
     * @throw SceneError if the interface or a lip in them is no arc. */
    ArcIntegral(const Body<2>               &body,
                const PointGeometry         &points,
                const TipRegion             &region,
                const InterfaceTip          &interface,
                const LoadParameters        &loads,
                const std::array<double, 2> &sizes);

    /** Collective. @throw SceneError if the thermal strain of one of the bodies
     * varies in the larger square. */
    void
    require_uniform(const MaterialState<2> &material) const;

    /** K_I and K_II, and the sum of what the other square and, for open lips, K
     * without G differ by. */
    struct Estimate
    {
      std::array<double, 2> intensity, error;
    };

    /** K at an instant. Collective.
     * @param t within the period.
     * @param material at this instant.
     * @param zone length of the closed lips next to the tip.
     * @param is_wide whether K is that of closed lips. */
    Estimate
    evaluate(const double            t,
             const Sample           &sample,
             const MaterialState<2> &material,
             const double            zone,
             const bool              is_wide) const;

  private:
    /** For each of both squares G, and what G and each unit field have
     * together. */
    using Sums = std::array<std::array<double, 3>, 2>;

    /** Quadrature point in the larger square: V and its gradient for both
     * squares, times the share of the area, and unit fields. */
    struct Place
    {
      std::size_t                         point;
      bool                                is_below;
      std::array<dealii::Tensor<1, 2>, 2> shift;
      std::array<dealii::Tensor<2, 2>, 2> gradient;
      std::array<ArcField::Gradients, 2>  units;
    };

    /** Contact node of this rank in the larger square. */
    struct ContactNode
    {
      std::size_t number; ///< in ContactBoundary::nodes
      double      s;      ///< distance from the tip along the lips
      /** Direction along the lips, times the sign that makes a jump of LipBasis
       * that of the body above relative to the body below. */
      dealii::Tensor<1, 2>  along;
      std::array<double, 2> weight; ///< q of both squares
      std::array<double, 2> units;  ///< n·[w,_s] of unit fields
    };

    /** V without its weight: turns about the centre of the circle. */
    dealii::Tensor<1, 2>
    turn(const dealii::Point<2> &local) const
    {
      const double k = region.tip.curvature;
      return dealii::Tensor<1, 2>({1. - k * local[1], k * local[0]});
    }

    void
    require_arc(const double size) const;
    void
    find_places(const std::array<SquareWeight, 2> &weights);
    void
    find_contact(const std::array<SquareWeight, 2> &weights);

    /** Gradients of the displacement at this rank's places, less the mean turn
     * of the larger square: forces in equilibrium do no work on a turn, but
     * those of a mesh are in equilibrium at nodes only. Collective. */
    std::vector<dealii::Tensor<2, 2>>
    slopes_at_places(const Vector &nodal) const;

    /** Adds what the area of this rank contributes. Collective. */
    void
    add_area(const double            t,
             const Vector           &nodal,
             const Vector           &stress,
             const MaterialState<2> &material,
             Sums                   &sums) const;

    /** Adds what lips of this rank that touch contribute. Collective.
     * @param zone length whose pressure counts in G only.
     * @return the slip in the zone, of the nodes of this rank. */
    double
    add_contact(const Vector        &nodal,
                const ContactForces &forces,
                const double         zone,
                Sums                &sums) const;

    const Body<2>                &body;
    const PointGeometry          &points;
    const TipRegion              &region;
    const InterfaceTip           &interface;
    const std::array<ArcField, 2> units; ///< of K_I = 1 and K_II = 1
    std::vector<std::pair<unsigned int, Expression>> body_force;
    std::vector<Place>                               places; ///< ascending
    std::vector<ContactNode>                         contact;
  };
} // namespace Crevasse

#endif
