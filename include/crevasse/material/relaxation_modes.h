// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_material_relaxation_modes_h
#define crevasse_material_relaxation_modes_h

#include <crevasse/material/voigt.h>

#include <algorithm>

namespace Crevasse
{
  /** The directions in which a stress relaxes alone, as columns of X, and its
   * rates: K = XXᵀ and XᵀHX = diag(l). In the plane only if the 33 row of K is
   * zero; then X has none either. */
  template <int dim>
  struct RelaxationModes
  {
    RelaxationModes() = default;

    /** @param H fluidity, symmetric and positive semidefinite.
     * @param K stiffness, symmetric and positive definite. */
    RelaxationModes(const VoigtMatrix<dim> &H, const VoigtMatrix<dim> &K);

    double
    largest_rate() const
    {
      return *std::max_element(rates.begin_raw(), rates.end_raw());
    }

    VoigtMatrix<dim> directions; ///< X
    VoigtVector<dim> rates;      ///< l
  };
} // namespace Crevasse

#endif
