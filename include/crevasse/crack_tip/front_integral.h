// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_front_integral_h
#define crevasse_crack_tip_front_integral_h

#include <crevasse/crack_tip/auxiliary_field.h>
#include <crevasse/crack_tip/front_region.h>
#include <crevasse/model/body.h>
#include <crevasse/time/observer.h>

namespace Crevasse
{
  /** The moduli of an isotropic body at a crack front, without the factor k. */
  struct FrontElasticity
  {
    double young_modulus, poisson_ratio;

    /** E' = E/(1 − ν²) */
    double
    modulus() const
    {
      return young_modulus / (1. - poisson_ratio * poisson_ratio);
    }
  };

  /**
   * K_I along the fronts of plane cracks as linear functions of the stress: the
   * InteractionIntegral of the half body in Betti's form, in the coordinates X,
   * Y, s of the front. For each vertex of the front, with its hat function
   * h(s), SquareWeight Q(X,Y) and q = h Q,
   *
   *     ∫ K_I h ds = E' ∫ [s:ε(w) − (S s + ε*):τ − b·w] dV
   *                  + ∫_lip 2 p q / √(2πr) dA,
   *     w = q u^B,    τ = inc(q φ^B t ⊗ t),
   *
   * with the plane field u^B, φ^B in the planes across the front, its tangent
   * t, and the incompatibility operator inc = ∇× (∇× ·)ᵀ. With g = 1 + kX,
   *
   *     τ_aa = φ_YY,  τ_nn = φ_XX + 2k φ_X/g,  τ_an = −φ_XY − k φ_Y/g,
   *
   * φ = q φ^B; the other components vanish. So τ is in equilibrium and leaves
   * the lip free however the front curves and q varies: no term is left out, as
   * those are that correct usual auxiliary fields for curvature (Gosz, Moran,
   * Eng. Fract. Mech. 69, 2002). ε(w) is the strain with the metric g.
   *
   * S s + ε* has to be compatible: the body is elastic, isotropic and the same
   * in the tube, or creeps with η = τ K and without free strain.
   */
  class FrontIntegral
  {
  public:
    /** Collective. All arguments must outlive this object.
     * @param size R of Q, at most FrontRegion::largest_radius. */
    FrontIntegral(const Body<3>         &body,
                  const FrontRegion     &region,
                  const LoadParameters  &loads,
                  const FrontElasticity &elasticity,
                  const double           size);

    /** K_I at the vertices of the front. Collective.
     * @param t within the period. @param material of that. */
    std::vector<double>
    values(const double            t,
           const Sample           &sample,
           const MaterialState<3> &material) const;

  private:
    /** What is multiplied at a point, times its share of the volume. */
    struct Field
    {
      VoigtVector<3> of_stress; ///< E' (ε(w) − S τ), with shears twofold
      VoigtVector<3> of_strain; ///< E' τ
      dealii::Tensor<1, 3> of_force; ///< E' w

      void
      add(const double factor, const Field &other)
      {
        of_stress += factor * other.of_stress;
        of_strain += factor * other.of_strain;
        of_force += factor * other.of_force;
      }
    };

    struct Kernel : Field
    {
      unsigned int     vertex = 0;
      std::size_t      point  = 0;
      dealii::Point<3> location;
    };

    /** For h = 1 and for its slope. @param frame not on the front. */
    std::pair<Field, Field>
    fields(const FrontFrame &frame) const;

    void
    integrate_over_cells();
    /** @return what a uniform pressure 1 gives, by vertex; of all ranks. */
    std::vector<double>
    integrate_over_lip();
    /** A uniform free strain contributes nothing, and so does a uniform stress
     * that the lip bears, to rounding: the rules in cells are not exact. */
    void
    balance(const std::vector<double> &lip);

    const Body<3>        &body;
    const FrontRegion    &region;
    const FrontElasticity elasticity;
    const SquareWeight    weight;

    std::vector<std::pair<unsigned int, Expression>> body_force;
    std::vector<Kernel>                              kernels;
    /** Of a node of the lip, by vertex of the front. */
    std::vector<std::tuple<unsigned int, std::size_t, double>>
      of_contact_forces;
  };
} // namespace Crevasse

#endif
