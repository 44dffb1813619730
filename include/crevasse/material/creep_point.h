// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_material_creep_point_h
#define crevasse_material_creep_point_h

#include <crevasse/creep/creep_law.h>
#include <crevasse/material/relaxation_modes.h>

#include <cmath>

namespace Crevasse
{
  /** Von Mises stress √(3/2 dev s : dev s). */
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
   * Creep law at a point of the body.
   *
   * The state y in the ODE is the creep strain r or, with hardening, R + wI
   * with the unit tensor I and
   *
   *     w = ε_c^(1+m),        R = ε_c^m r,
   *     ẇ = η₀⁻¹ (1+m) f,     Ṙ = η₀⁻¹ f (N + m R/w).
   *
   * These rates are finite where creep begins (R/w = N there), and constant
   * under constant stress. R has no trace, so that y determines w and R. Stages
   * may have w < 0 near rest, which counts as w = 0.
   */
  template <int dim>
  struct CreepPoint
  {
    /** Creep strain r of a state y. */
    VoigtVector<dim>
    strain(const VoigtVector<dim> &state) const;

    /** r + ε_c I of a state y, for transfer to another mesh. */
    VoigtVector<dim>
    strains(const VoigtVector<dim> &state) const;

    /** State y of r + ε_c I. Raises ε_c to the norm of r if a projection has
     * made it smaller. */
    VoigtVector<dim>
    state(const VoigtVector<dim> &strains) const;

    const CreepLaw      *law;
    CreepLaw::Constants  constants;
    RelaxationModes<dim> modes; ///< modes of H and K, N = Hs/s

    struct Rate
    {
      VoigtVector<dim> of_state; ///< rate η₀ẏ
      /** Upper bound of the relaxation rate of the stress, times η₀: the
       * largest eigenvalue of λf/s HK. It bounds K ∂ṙ/∂s, since the second part
       * of ∂ṙ/∂s = f/s (H + (λ − 1) Hs⊗Hs / sHs) is at most λ − 1 times the
       * first (Cauchy–Schwarz), with equality along s. Hardening lowers the
       * rate within a step: at the end of the longest stable step from rest,
       * ε_c = 2s/(kλl). */
      double of_relaxation;
    };

    /** Creep rate under a stress, with the stiffness kK.
     *
     * @param state y; with κ = c k/η₀ > 0, ŷ of an implicit step y = ŷ + cẏ. */
    Rate
    rate(const VoigtVector<dim> &stress,
         const VoigtVector<dim> &state,
         const double            k,
         const double            kappa = 0.) const;

    /** ∂ṙ/∂s times η₀ under a stress, without hardening:
     * f/s (H + (λ − 1) Hs⊗Hs / sHs). */
    VoigtMatrix<dim>
    fluidity(const VoigtVector<dim> &stress) const;

    /** Potential Ω of a stress, see CreepLaw. */
    CreepLaw::DualPotential
    dual_potential(const VoigtVector<dim> &stress) const;

    /**
     * Stress s for a strain e at the end of an implicit step:
     *
     *     s = kK (e − r),     y = ŷ + c ẏ(s),     κ = c k/η₀.
     *
     * With a = f κ/k, w = ŵ + (1+m)a and β = w^(1/(1+m)) / (ŵ + a), the creep
     * strain is r = β (R̂ + aN), without hardening r̂ + aN. Then s = kXv with
     * vᵢ = (Xᵀ(e − βR̂))ᵢ / (1 + ρlᵢ), ρ = βκf/s: a scalar equation for ln s,
     * with slopes from 1 to λ without hardening.
     *
     * @param strain e, without thermal strain
     * @param known ŷ
     * @throw NumericalError if the iteration fails.
     */
    VoigtVector<dim>
    relaxed_stress(const VoigtVector<dim> &strain,
                   const VoigtVector<dim> &known,
                   const double            k,
                   const double            log_kappa) const;

    /**
     * Derivative ds/de of relaxed_stress() at its result s, without factor k:
     *
     *     X [I + ρ (diag(l) + (λ' − 1) vvᵀ / s²)]⁻¹ Xᵀ,     v = XᵀHs,
     *
     * with λ' = λ (ŵ + a)/w; symmetric and positive definite. With hardening
     * it is an approximation, with ŵN for R̂.
     */
    VoigtMatrix<dim>
    relaxed_stiffness(const VoigtVector<dim> &stress,
                      const VoigtVector<dim> &known,
                      const double            k,
                      const double            log_kappa) const;

  private:
    /** Implicit step that ends with the stress s. */
    struct Step
    {
      double rho;            ///< ρ, limited so that its square is finite
      double left_out;       ///< part of ln ρ beyond the limit
      double radial_slope;   ///< slope λ'
      double growth_of_rho;  ///< d ln ρ / d ln s
      double beta;           ///< factor β
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
