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
