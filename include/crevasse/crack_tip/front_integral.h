// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_front_integral_h
#define crevasse_crack_tip_front_integral_h

#include <crevasse/crack_tip/front_field.h>
#include <crevasse/crack_tip/front_region.h>
#include <crevasse/crack_tip/lip_forces.h>
#include <crevasse/model/body.h>
#include <crevasse/time/observer.h>

namespace Crevasse
{
  /**
   * Computes K_I along plane cracks' fronts as linear functions of the stress,
   * and K_II or K_III of cracks with two lips, by the InteractionIntegral in
   * Betti's form, in coordinates X, Y, s of the front. For each vertex of the
   * front, with its hat function h(s), SquareWeight Q(X,Y) and q = h Q,
   *
   *     ∫ K h ds = M ∫ [s:ε(w) − (S s + ε*):τ − b·w] dV
   *                − ∫_lips (p n + t)·M w dA,
   *     w = q u^B,    τ = inc(q φ^B t ⊗ t),
   *
   * with the pressure p of contact, a force t on the lips, given or of
   * friction, M = E', the plane field u^B, φ^B in the planes across the front,
   * its tangent t, the normal n of the crack into the body, and the
   * incompatibility operator inc = ∇× (∇× ·)ᵀ. With g = 1 + kX,
   *
   *     τ_aa = φ_YY,  τ_nn = φ_XX + 2k φ_X/g,  τ_an = −φ_XY − k φ_Y/g,
   *
   * φ = q φ^B; the other components vanish. For K_III, M = 2μ, u^B = u_t t is
   * the antiplane field, and τ = inc(q A^B (t ⊗ n + n ⊗ t)), where A = q A^B
   * has
   *
   *     τ_at = A_XY − k A_Y/g,   τ_nt = −(A_X + k A/g)_X,
   *     τ_aa = −2 A_Ys/g,        τ_an = (A_X + k A/g)_s/g.
   *
   * So τ is in equilibrium and leaves the lips free for any curvature of the
   * front and any q. No terms that correct auxiliary fields for curvature are
   * missing (Gosz, Moran, Eng. Fract. Mech. 69, 2002), except for K_III the
   * derivative of k along the front. ε(w) is the strain with the metric g. At
   * the ends of a front, where w and τ of K_III do work, K_III is extrapolated
   * from the neighbouring vertices, or 0 on planes of symmetry.
   *
   * S s + ε* must be compatible: in the tube, the body is elastic, isotropic
   * and homogeneous, or creeps with η = τ K and without free strain.
   */
  class FrontIntegral
  {
  public:
    /** Collective. The arguments must outlive the FrontIntegral.
     * @param fields with a weight whose radius is at most
     * FrontRegion::largest_radius. */
    FrontIntegral(const Body<3>        &body,
                  const FrontRegion    &region,
                  const LoadParameters &loads,
                  const FrontFields    &fields);

    /** K at the vertices of the front. Collective.
     * @param t within the period. @param material at the instant t. */
    std::vector<double>
    values(const double            t,
           const Sample           &sample,
           const MaterialState<3> &material) const;

    /** K at the vertices of the front of a stress and the contact forces of a
     * body without free strain, and without other loads in the tube.
     * Collective. */
    std::vector<double>
    values(const Vector &stress, const ContactForces &contact_forces) const
    {
      return at_vertices(sums_of(stress), contact_forces);
    }

    const FrontFields fields;

  private:
    /** Factors at a quadrature point, times its share of the volume. */
    struct Kernel : FrontField
    {
      unsigned int     vertex = 0;
      std::size_t      point  = 0;
      dealii::Point<3> location;
    };

    /** Shares of this rank in the integrals ∫ K h ds of a stress, by vertex. */
    std::vector<double>
    sums_of(const Vector &stress) const;

    /** K of the shares of all ranks and of contact forces. Collective. */
    std::vector<double>
    at_vertices(std::vector<double>  K,
                const ContactForces &contact_forces) const;

    void
    integrate_over_cells();
    /** Returns, by vertex, the factors of a uniform stress that the lips of all
     * ranks bear. */
    std::vector<VoigtVector<3>>
    integrate_over_lips();

    /** By vertex of the front, on this rank: factors of a uniform stress that
     * the lips bear, and of the tractions that dofs interpolate: of a pressure
     * or, with friction, of each component of the shear on the side to which
     * the front's normal points. */
    struct LipSums
    {
      std::vector<VoigtVector<3>> of_stress;
      std::vector<
        std::map<dealii::types::global_dof_index, dealii::Tensor<1, 3>>>
        of_traction;
    };

    /** Number of components of LipSums::of_traction. */
    unsigned int
    n_tractions() const
    {
      return fields.mode == CrackMode::opening ? 1 : body.friction ? 3 : 0;
    }

    /** Adds a quadrature point of a lip behind the front. */
    void
    add_lip_point(const dealii::FEFaceValues<3>                      &values,
                  const unsigned int                                  q,
                  const std::vector<dealii::types::global_dof_index> &dofs,
                  LipSums                                            &sums);
    /** Contribution of the contact forces along the normal (0) or a tangent (1,
     * 2) to a vertex. Collective. @param frames at this rank's nodes.
     * @param factors of the normal force, or of the components of forces.
     * @param reach of the line that continues forces to the front. */
    LipForces
    forces_at(const unsigned int                      vertex,
              const unsigned int                      component,
              const std::vector<FrontFrame>          &frames,
              const std::vector<std::vector<double>> &factors,
              const double                            reach) const;
    /** Keeps the factors of contact forces. */
    void
    keep_contact_forces(const LipSums &sums);
    /** Corrects the factors so that a uniform free strain contributes nothing,
     * and a uniform stress as much as the lips: quadrature is not exact. */
    void
    balance(const std::vector<VoigtVector<3>> &lips);
    /** Components of a stress factor that do work at a vertex on lips only. */
    VoigtVector<3>
    what_lips_bear(const unsigned int v, const VoigtVector<3> &of_stress) const;

    const Body<3>     &body;
    const FrontRegion &region;

    /** Point of a loaded lip, with its vertex of the front. */
    struct LoadedPoint
    {
      unsigned int               vertex;
      dealii::types::boundary_id id;
      dealii::Point<3>           point;
      dealii::Tensor<1, 3>       normal, of_force;
    };

    const LoadParameters                            &loads;
    std::vector<LoadedPoint>                         loaded;
    std::vector<std::pair<unsigned int, Expression>> body_force;
    std::vector<Kernel>                              kernels;

    struct ContactShare
    {
      unsigned int vertex;    ///< vertex of the front
      unsigned int component; ///< 0: normal; then tangents
      LipForces    forces;
    };

    std::vector<ContactShare> of_contact_forces;
  };
} // namespace Crevasse

#endif
