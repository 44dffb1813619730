// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_material_creep_power_h
#define crevasse_material_creep_power_h

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

  /** Creep by a power law at a point: the fluidity is A s_eq^(n−1) H, with the
   * H of an incompressible body of unit modulus. */
  template <int dim>
  struct CreepPower
  {
    double               exponent;    ///< n
    double               coefficient; ///< A
    RelaxationModes<dim> modes;       ///< of H and the stiffness K

    /**
     * The largest eigenvalue of nAHK: the stress s relaxes at this rate times
     * k/η₀ factor(s), or slower. For K ∂ṙ/∂s is at most that, as a quadratic
     * form: the second part of ∂ṙ/∂s = A/η₀ s_eq^(n−1) (H + (n−1) Hs⊗Hs / sHs)
     * is no more than n − 1 times the first (Cauchy and Schwarz), and as much
     * along s.
     */
    double
    rate() const
    {
      return exponent * coefficient * modes.largest_rate();
    }

    /** s_eq^(n−1) */
    double
    factor(const VoigtVector<dim> &stress) const
    {
      return std::pow(equivalent_stress<dim>(stress), exponent - 1.);
    }

    /**
     * What the strain e bears at the end of an implicit step: the s of
     *
     *     s = kK (e − c ṙ(s)),     κ = c k/η₀.
     *
     * It is kXy with yᵢ = (Xᵀe)ᵢ / (1 + κAm lᵢ), and m = s_eq^(n−1) is the
     * zero of ln m − (n−1) ln s_eq(m), whose slope is 1 to n in ln m.
     *
     * @throw NumericalError if it is not found.
     */
    VoigtVector<dim>
    relaxed_stress(const VoigtVector<dim> &strain,
                   const double            k,
                   const double            kappa) const;

    /**
     * ds/de of that without its factor k, for a stress s that was found:
     *
     *     X [I + κAm (diag(l) + (n−1) vvᵀ / s_eq²)]⁻¹ Xᵀ,     v = XᵀHs,
     *
     * symmetric and positive definite.
     */
    VoigtMatrix<dim>
    relaxed_stiffness(const VoigtVector<dim> &stress, const double kappa) const;
  };
} // namespace Crevasse

#endif
