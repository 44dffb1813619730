// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_material_isotropic_h
#define crevasse_material_isotropic_h

#include <crevasse/material/voigt.h>

namespace Crevasse
{
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

  /** Whether a matrix is that of an isotropic body or at least has, as those of
   * cubic symmetry, the eigenvectors of one: the same entries for all
   * directions, the same for all shears, no coupling of the two; perhaps
   * without the 33 row and column. */
  template <int dim>
  bool
  is_isotropic(const VoigtMatrix<dim> &matrix);
} // namespace Crevasse

#endif
