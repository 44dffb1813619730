// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_material_creep_point_h
#define crevasse_material_creep_point_h

#include <crevasse/creep/creep_law.h>
#include <crevasse/material/relaxation_modes.h>

#include <cmath>

namespace Crevasse
{
  /** Von Mises' stress √(3/2 dev s : dev s). */
  template <int dim>
  double
  equivalent_stress(const VoigtVector<dim> &stress)
  {
    const auto square = [](const double x) { return x * x; };
    double     shears = 0.;
    for (unsigned int i = 3; i < n_stress_components<dim>; ++i)
      shears += square(stress[i]);
    return std::sqrt(0.5 * (square(stress[0] - stress[1]) +
                            square(stress[1] - stress[2]) +
                            square(stress[2] - stress[0])) +
                     3. * shears);
  }

  /**
   * A creep law at a point of the body.
   *
   * The ODE integrates the creep strain r; of a law that hardens it integrates
   * y = R + wI of the unit tensor I and
   *
   *     w = ε_c^(1+m),        R = ε_c^m r,
   *     ẇ = η₀⁻¹ (1+m) f,     Ṙ = η₀⁻¹ f (N + m R/w),
   *
   * whose rates are finite where creep begins (there R/w is N), and constant
   * under a constant stress. R has no trace, so that y tells both. A stage that
   * begins at rest may have w < 0: it is at rest.
   */
  template <int dim>
  struct CreepPoint
  {
    /** r of a state y. */
    VoigtVector<dim>
    strain(const VoigtVector<dim> &state) const;

    /** r + ε_c I of a state y, which other meshes can take over. */
    VoigtVector<dim>
    strains(const VoigtVector<dim> &state) const;

    /** State y of r + ε_c I; ε_c is at least the size of r, which projections
     * may violate. */
    VoigtVector<dim>
    state(const VoigtVector<dim> &strains) const;

    const CreepLaw      *law;
    CreepLaw::Constants  constants;
    RelaxationModes<dim> modes; ///< of N = Hs/s and the stiffness K

    struct Rate
    {
      VoigtVector<dim> of_state; ///< η₀ẏ
      /** The rate at which the stress relaxes, or more, times η₀: the largest
       * eigenvalue of λf/s HK. For K ∂ṙ/∂s is at most that, as a quadratic
       * form: the second part of ∂ṙ/∂s = f/s (H + (λ − 1) Hs⊗Hs / sHs) is no
       * more than λ − 1 times the first (Cauchy and Schwarz), and as much along
       * s. Hardening from rest lessens it within the step: at the end of the
       * longest stable one it is that of ε_c = 2s/(kλl). */
      double of_relaxation;
    };

    /** Creep under a stress where the stiffness is kK.
     *
     * @param state y, or with κ = c k/η₀ the ŷ of an implicit step y = ŷ + cẏ.
     */
    Rate
    rate(const VoigtVector<dim> &stress,
         const VoigtVector<dim> &state,
         const double            k,
         const double            kappa = 0.) const;

    /** Ω of a stress, see CreepLaw. */
    CreepLaw::DualPotential
    dual_potential(const VoigtVector<dim> &stress) const;

    /**
     * What the strain e bears at the end of an implicit step: the s of
     *
     *     s = kK (e − r),     y = ŷ + c ẏ(s),     κ = c k/η₀.
     *
     * With a = f κ/k, w = ŵ + (1+m)a and β = w^(1/(1+m)) / (ŵ + a) it is
     * r = β (R̂ + aN), without hardening r̂ + aN. Then s = kXv with
     * vᵢ = (Xᵀ(e − βR̂))ᵢ / (1 + ρlᵢ), ρ = βκf/s: one equation for ln s, whose
     * slope is 1 to λ without hardening.
     *
     * @param strain e, without thermal strain
     * @param known ŷ
     * @throw NumericalError if it is not found.
     */
    VoigtVector<dim>
    relaxed_stress(const VoigtVector<dim> &strain,
                   const VoigtVector<dim> &known,
                   const double            k,
                   const double            log_kappa) const;

    /**
     * ds/de of that without its factor k, for a stress s that was found:
     *
     *     X [I + ρ (diag(l) + (λ' − 1) vvᵀ / s²)]⁻¹ Xᵀ,     v = XᵀHs,
     *
     * symmetric and positive definite, λ' = λ (ŵ + a)/w. With hardening it
     * takes R̂ as if it were ŵN.
     */
    VoigtMatrix<dim>
    relaxed_stiffness(const VoigtVector<dim> &stress,
                      const VoigtVector<dim> &known,
                      const double            k,
                      const double            log_kappa) const;

  private:
    /** An implicit step that ends with the stress s. */
    struct Step
    {
      double rho;            ///< ρ, at most about a number whose square is one
      double left_out;       ///< the rest of ln ρ
      double radial_slope;   ///< λ'
      double growth_of_rho;  ///< d ln ρ / d ln s
      double beta;           ///< β
      double growth_of_beta; ///< dβ / d ln s
    };

    /** @param known ŵ */
    Step
    step(const double log_stress,
         const double known,
         const double k,
         const double log_kappa) const;
  };
} // namespace Crevasse

#endif
