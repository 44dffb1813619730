// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_singular_functions_h
#define crevasse_discretisation_singular_functions_h

#include <crevasse/discretisation/crack_tip.h>
#include <crevasse/discretisation/polar_field.h>
#include <crevasse/material/plane_elasticity.h>

#include <vector>

namespace Crevasse
{


  /**
   * Displacements ψ of mode I with the singularities of a crack tip, to be
   * added to the finite elements (Strang and Fix 1973, §8.2; the end of §7 of
   * the paper): w₁, the field of K_I; D, which with w₁ spans all displacements
   * with √r whatever Poisson's ratio; w₃, the term with r^{3/2} of Williams'
   * series.
   *
   * They are scaled by a length h, the size of the cells at the tip, and to an
   * opening of 1 there, so that a coefficient is a displacement as those of the
   * nodes are, in any units.
   */
  struct SingularFunctions
  {
    CrackTip                tip;
    std::vector<PolarField> fields; ///< none: they are off

    /** K_I of a unit coefficient of w₁ (stress √length / length). */
    double unit_stress_intensity = 0.;
  };

  /** @param n from 1 to 3.
   * @param length h */
  SingularFunctions
  make_singular_functions(const unsigned int     n,
                          const CrackTip        &tip,
                          const PlaneElasticity &elasticity,
                          const double           length);
} // namespace Crevasse

#endif
