// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#ifndef crevasse_material_maxwell_law_h
#define crevasse_material_maxwell_law_h

#include <crevasse/material/voigt.h>
#include <crevasse/scene/parameters.h>

namespace Crevasse
{
  /**
   * Stress and creep of a Maxwell body (paper, §3):
   *
   *     s = K (e − r),      ṙ = H s,      H = η⁻¹
   *
   * with the stiffness K (symmetric, positive definite; its 33 row and column
   * are zero in plane stress) and the fluidity H (symmetric, positive
   * semidefinite).
   */
  template <int dim>
  class MaxwellLaw
  {
  public:
    /** Elastic when the scene's viscosity is "none": H = 0. */
    explicit MaxwellLaw(const MaterialParameters &parameters);

    /** K, in units of stress. */
    const VoigtMatrix<dim> &
    stiffness() const;

    /** H, in units of 1/(stress × time). */
    const VoigtMatrix<dim> &
    fluidity() const;

    /**
     * The smallest relaxation time τ_min: τ_min⁻¹ is the largest eigenvalue of
     * HK, which explicit schemes must resolve. Infinite for an elastic law.
     */
    double
    smallest_relaxation_time() const;

    /**
     * The τ of proportional flow, H = (τK)⁻¹, from which uniform relaxation
     * follows; 0 if the scene gives the flow its own moduli.
     */
    double
    uniform_relaxation_time() const;

  private:
    VoigtMatrix<dim> K;
    VoigtMatrix<dim> H;
    double           uniform_tau;
  };

  /**
   * The stiffness of an isotropic body in plane stress (33 row and column
   * zero), plane strain or three dimensions.
   */
  template <int dim>
  VoigtMatrix<dim>
  isotropic_stiffness(const double young_modulus,
                      const double poisson_ratio,
                      const bool   plane_stress);

  /** The inverse of the three-dimensional isotropic stiffness; defined up to
   * and including the Poisson ratio ½ (purely deviatoric). */
  template <int dim>
  VoigtMatrix<dim>
  isotropic_compliance(const double young_modulus, const double poisson_ratio);

  /** The largest eigenvalue of H K, both symmetric and positive semidefinite.
   * Unit: 1/time. */
  template <int dim>
  double
  largest_relaxation_rate(const VoigtMatrix<dim> &H, const VoigtMatrix<dim> &K);
} // namespace Crevasse

#endif
