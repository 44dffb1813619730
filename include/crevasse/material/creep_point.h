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

  /** A creep law at a point of the body. */
  template <int dim>
  struct CreepPoint
  {
    const CreepLaw      *law;
    CreepLaw::Constants  constants;
    RelaxationModes<dim> modes; ///< of N = Hs/s and the stiffness K

    struct Rate
    {
      VoigtVector<dim> of_strain; ///< η₀ṙ
      /** The rate at which the stress relaxes, or more, times η₀: the largest
       * eigenvalue of λf/s HK. For K ∂ṙ/∂s is at most that, as a quadratic
       * form: the second part of ∂ṙ/∂s = f/s (H + (λ − 1) Hs⊗Hs / sHs) is no
       * more than λ − 1 times the first (Cauchy and Schwarz), and as much along
       * s. */
      double of_relaxation;
    };

    /** Creep under a stress where the stiffness is kK. */
    Rate
    rate(const VoigtVector<dim> &stress, const double k) const;

    /** Ω of a stress, see CreepLaw. */
    CreepLaw::DualPotential
    dual_potential(const VoigtVector<dim> &stress) const;

    /**
     * What the strain e bears at the end of an implicit step: the s of
     *
     *     s = kK (e − c ṙ(s)),     κ = c k/η₀.
     *
     * It is kXy with yᵢ = (Xᵀe)ᵢ / (1 + ρlᵢ), ρ = κf/s: one equation for ln s,
     * whose slope is 1 to λ.
     *
     * @throw NumericalError if it is not found.
     */
    VoigtVector<dim>
    relaxed_stress(const VoigtVector<dim> &strain,
                   const double            k,
                   const double            log_kappa) const;

    /**
     * ds/de of that without its factor k, for a stress s that was found:
     *
     *     X [I + ρ (diag(l) + (λ − 1) vvᵀ / s²)]⁻¹ Xᵀ,     v = XᵀHs,
     *
     * symmetric and positive definite.
     */
    VoigtMatrix<dim>
    relaxed_stiffness(const VoigtVector<dim> &stress,
                      const double            log_kappa) const;

  private:
    /** An implicit step that ends with the stress s. */
    struct Step
    {
      double rho;      ///< ρ, at most a number whose square is one
      double left_out; ///< the rest of ln ρ
      double slope;    ///< λ
    };

    Step
    step(const double log_stress, const double log_kappa) const;
  };
} // namespace Crevasse

#endif
