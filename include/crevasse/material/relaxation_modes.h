// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_material_relaxation_modes_h
#define crevasse_material_relaxation_modes_h

#include <crevasse/material/voigt.h>

#include <algorithm>

namespace Crevasse
{
  /** Directions in which stress relaxes independently, the columns of X, and
   * its rates l: K = XXᵀ and XᵀHX = diag(l). If row 33 of K is zero, so is that
   * of X. */
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

    VoigtMatrix<dim> directions; ///< columns of X
    VoigtVector<dim> rates;      ///< rates l
  };
} // namespace Crevasse

#endif
