// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_interaction_integral_h
#define crevasse_crack_tip_interaction_integral_h

#include <crevasse/crack_tip/auxiliary_field.h>
#include <crevasse/crack_tip/lip_integral.h>
#include <crevasse/crack_tip/tip_elasticity.h>
#include <crevasse/crack_tip/tip_region.h>
#include <crevasse/model/body.h>
#include <crevasse/time/observer.h>

namespace Crevasse
{
  /**
   * Computes the stress intensity factor K_I as a linear function of the stress
   * and of the strain without stress, by the interaction integral (Yau, Wang,
   * Corten, J. Appl. Mech. 47, 1980) of the half body above the crack, in the
   * form of Betti's theorem. If the tip has two lips, K_I is half the integral
   * over both sides, and K_II follows with the auxiliary field of K_II = 1,
   * which has no displacement across straight lips, so that their pressure p
   * does not enter. With the auxiliary field of K_I = 1, differentiated along
   * the crack (σ^B ~ r^(−3/2), displacement u^B, stress function φ^B ~ √r), and
   * a weight q,
   *
   *     w = q u^B,     τ = curl curl (q φ^B) = q σ^B + τ′,
   *
   *     K_I = E' ∫ [s:ε(w) − ε(u):τ − b·w] dA + ∫_lip 2 p q / √(2πr) ds
   *           − E' ∫_lip t·w ds
   *         = ∫ s:N dA − E' ∫ [(S − S_tip) s + ε*]:τ dA − …,
   *     N   = E' (sym(∇q ⊗ u^B) − S_tip τ′).
   *
   * with the pressure p of contact and the given force t on the lip. S is the
   * compliance in the plane and ε* the strain without stress. τ is in
   * equilibrium and leaves the lip free, so compatible strains, e.g. uniform
   * ones, contribute nothing. No derivative of moduli or strains occurs: they
   * may vary and jump (the "incompatibility formulation": Dolbow, Gosz, Int. J.
   * Solids Struct. 39, 2002; Kim, Paulino, J. Appl. Mech. 72, 2005).
   *
   * Viscous strain is as singular as the stress, and its product with τ is only
   * conditionally integrable. But where creep is isotropic and uniform, viscous
   * strain is compatible like S_tip s. So only viscous strain outside a square
   * of size a with uniform creep enters, by τ of q minus τ of the smaller
   * square's weight. If creep varies at the tip, the error is linear in a, and
   * 2 K_I(a) − K_I(2a) is used.
   *
   * In a body of revolution the crack front is a circle, with the fields of
   * FrontFields: τ is in equilibrium on rings, and N, with hoop components,
   * contains what the fields lack to a solution. Integrals are over one radian,
   * divided by the radius of the front. N then depends on κ in another way, so
   * a single κ is supported.
   *
   * Lips that bend are not free of τ's forces: their displacement adds E' ∫_lip
   * u·τn ds, in an elastic body. The fields are continued from their line to
   * the LipPath.
   *
   * In an anisotropic body the fields are those of AnisotropicTip, and between
   * two bodies those of InterfaceTip, without E'. Displacements of the latter
   * have a jump across the lips, so that their pressure enters.
   *
   * The weight q is SquareWeight in the square |X| ≤ R, 0 ≤ Y ≤ R, or
   * |Y| ≤ R. In cells of the usual rule N and τ are projected to the
   * polynomials through its points, so that a polynomial stress is integrated
   * exactly. By Betti's theorem the error of K_I is of the order of the squared
   * error in the energy norm.
   */
  class InteractionIntegral
  {
  public:
    /** Squares around the tip, given by half their side. */
    struct Squares
    {
      double size; ///< R ≤ TipRegion::largest_radius()
      /** Size a of a square whose viscous strain is left out; R: all is. */
      double creep;
      /** Whether creep varies in the square of size a. */
      bool extrapolates;
      /** κ at the tip of a body of revolution; otherwise 0. */
      double kappa_of_ring = 0.;
      /** Elasticity at a tip in an anisotropic body; otherwise null. */
      const AnisotropicTip *anisotropic = nullptr;
      /** Elasticity at a tip between two bodies; otherwise null. */
      const InterfaceTip *interface = nullptr;
      /** Whether the field between two bodies is that of closed lips. */
      bool is_closed = false;
    };

    /** Collective. The arguments must outlive the InteractionIntegral. */
    InteractionIntegral(const Body<2>        &body,
                        const PointGeometry  &points,
                        const TipRegion      &region,
                        const CrackMode       mode,
                        const LoadParameters &loads,
                        const Squares        &squares);

    /** K at an instant. Collective.
     * @param t within the period.
     * @param contact_forces those that enter: without those in a small contact
     * zone.
     * @param material at this instant.
     * @param at_tip stiffness at the tip, without the factor k. */
    double
    value(const double            t,
          const Sample           &sample,
          const ContactForces    &contact_forces,
          const MaterialState<2> &material,
          const TipElasticity    &at_tip) const;

    /** Factor of the stress at the points in K of an elastic body, without what
     * lips that bend or press contribute: N − E' (S − S_tip) τ. */
    Vector
    factor_of_stress(const MaterialState<2> &material,
                     const TipElasticity    &at_tip) const;

    /** Factors of the normal forces of the lip's local nodes in K_I of an
     * elastic body with straight lips. */
    std::vector<double>
    factors_of_forces() const
    {
      return of_contact_forces.factors(body.lip.nodes.size());
    }

    /** K = ∫ s:N dA + ∫_lip … for a homogeneous body without free strain or
     * body force in the square: elastic, or viscous with the stress of a flow.
     * Collective. */
    double
    of_uniform_body(const Vector        &stress,
                    const ContactForces &contact_forces,
                    const double         kappa) const;

  private:
    /** Factors at a quadrature point, times its share of the area. */
    struct Kernel
    {
      std::size_t    point = 0;
      AuxiliaryField field;
      VoigtVector<2> of_viscous_strain;
      /** Factor at this point of a field's limit at the tip, by the cell's
       * polynomials; 0 in other cells than those at the tip. */
      double of_limit = 0.;

      void
      add(const double factor, const Kernel &other)
      {
        field.add(factor, other.field);
        of_viscous_strain += factor * other.of_viscous_strain;
      }
    };

    void
    integrate_over_cells(const Squares &squares);

    /** @param local the point (X, Y). */
    AuxiliaryField
    field_at(const dealii::Point<2> &local, const SquareWeight &weight) const;

    /** Strain E' S s of a stress without shear on rings, as of_stress[0] has
     * it.
     */
    VoigtVector<2>
    strain_on_rings(const VoigtVector<2> &stress) const;

    /** Factor of the hoop strain on rings in N, which T's field makes singular
     * like 1/r². Its integral over a square around the tip is 0. */
    double
    hoops_at(const dealii::Point<2> &local, const SquareWeight &weight) const;

    /** Factor of a field that is continued at a point of a cell. */
    double
    sign(const dealii::Point<2> &center, const dealii::Point<2> &local) const
    {
      return mode == CrackMode::constant ? 1.
                                         : region.sign_of_root(center, local);
    }

    /** Factor of a field at a point of a lip. */
    double
    factor(const LipPoint &point) const
    {
      return point.weight * (mode == CrackMode::constant ? 1. : point.sign);
    }

    /** Factors of displacement and pressure on lips that bend, or between two
     * bodies. */
    void
    integrate_over_bends(const double size);

    /** Factors of the displacement of the lips. */
    void
    integrate_displacement(const double size);

    /** Integrates over the lips: keeps the loaded points.
     * @return the factors of a uniform stress that the lips bear. */
    std::array<VoigtVector<2>, 2>
    integrate_over_lips(const double size);

    /** Makes a uniform strain contribute nothing, and a uniform stress as much
     * as the lips bear of it, to rounding: the rules in the cells at the tip
     * are not exact. Between two bodies, makes a uniform strain of each
     * contribute what the interface bears. */
    void
    balance(const std::array<VoigtVector<2>, 2> &lips, const double size);

    /** Integral of τ over the body above an interface. */
    VoigtVector<2>
    strain_factor_above(const double size) const;

    /** Whether a point is in the body below an interface. */
    bool
    is_below(const Kernel &kernel) const
    {
      return interface != nullptr &&
             region.tip.local(points.location[kernel.point])[1] < 0.;
    }

    /** Components of a factor of uniform stress that the body can bear without
     * other forces than those on the lips. */
    VoigtVector<2>
    what_lips_bear(const VoigtVector<2> &of_stress) const;

    /** Contribution, on this rank, of body force and loads on lips. */
    double
    of_forces(const double t, const double kappa) const;

    /** Contribution, on this rank, of varying moduli, thermal strain, creep. */
    double
    of_variation(const Sample           &sample,
                 const MaterialState<2> &material,
                 const TipElasticity    &at_tip,
                 const bool              creeps) const;

    const Body<2>                                   &body;
    const PointGeometry                             &points;
    const TipRegion                                 &region;
    const CrackMode                                  mode;
    const double                                     kappa_of_ring;
    const AnisotropicTip *const                      anisotropic;
    const InterfaceTip *const                        interface;
    const bool                                       is_closed;
    const LoadParameters                            &loads;
    std::vector<std::pair<unsigned int, Expression>> body_force;
    std::vector<std::pair<LipPoint, AuxiliaryField>> loaded; ///< on lips
    std::vector<Kernel>                              kernels;
    bool      has_creep = false; ///< whether viscous strain enters
    double    of_hoops  = 0.;    ///< integral of hoops_at()
    LipForces of_contact_forces;
    /** On lips that bend, or that are closed between two bodies. */
    Vector of_displacement;
    /** Integral of τ over the square, which lips that bend bear. */
    VoigtVector<2>                     of_uniform_strain;
    std::array<std::vector<double>, 2> of_pressure_on_bends;
  };
} // namespace Crevasse

#endif
