// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_material_creep_power_h
#define crevasse_material_creep_power_h

#include <crevasse/material/voigt.h>

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

  /** How creep by a power law depends on the stress at a point. */
  struct CreepPower
  {
    double exponent; ///< n

    /**
     * The largest eigenvalue of nHK: the stress s relaxes at this rate times
     * k/η₀ factor(s), or slower. For K ∂ṙ/∂s is at most that, as a quadratic
     * form: the second part of ∂ṙ/∂s = η₀⁻¹ s_eq^(n−1) (H + (n−1) Hs⊗Hs / sHs)
     * is no more than n − 1 times the first (Cauchy and Schwarz), and as much
     * along s.
     */
    double rate;

    /** s_eq^(n−1), by which the fluidity H is multiplied. */
    template <int dim>
    double
    factor(const VoigtVector<dim> &stress) const
    {
      return std::pow(equivalent_stress<dim>(stress), exponent - 1.);
    }
  };
} // namespace Crevasse

#endif
