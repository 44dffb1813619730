// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_material_phi_functions_h
#define crevasse_material_phi_functions_h

#include <crevasse/material/voigt.h>

namespace Crevasse
{
  /** φ₁(z) = (e^z − 1)/z and φ₂(z) = (φ₁(z) − 1)/z of a matrix, the functions
   * of exponential integrators. */
  template <int dim>
  struct PhiFunctions
  {
    VoigtMatrix<dim> first, second;
  };

  /** Of −@p rate, whose eigenvalues are real and positive or zero, as those of
   * HK are. By Taylor's series of a fraction 2⁻ⁿ of it and n doublings, which
   * needs no eigenvectors and no inverse, and loses no digits: all terms of the
   * doublings are positive. @throw NumericalError if it is not finite. */
  template <int dim>
  PhiFunctions<dim>
  decay_functions(const VoigtMatrix<dim> &rate);
} // namespace Crevasse

#endif
