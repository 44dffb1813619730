// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_material_voigt_matrix_h
#define crevasse_material_voigt_matrix_h

#include <crevasse/material/voigt.h>

namespace Crevasse
{
  // Linear algebra of the small matrices of a material. In plane stress the 33
  // row and column of a stiffness or viscosity are zero; then "in the plane"
  // means without them.

  /** The inverse of a symmetric matrix, in the plane only if its 33 row is
   * zero. @throw NumericalError if it is singular. */
  template <int dim>
  VoigtMatrix<dim>
  inverse(const VoigtMatrix<dim> &matrix);

  /** (I + K H)⁻¹ K, for two symmetric matrices, positive semidefinite: what K
   * bears where H gives way. */
  template <int dim>
  VoigtMatrix<dim>
  relaxed_stiffness(const VoigtMatrix<dim> &K, const VoigtMatrix<dim> &H);

  /** What is left of a stiffness where the strain 33 follows from s₃₃ = 0. */
  template <int dim>
  VoigtMatrix<dim>
  condense_thickness(const VoigtMatrix<dim> &matrix);

  /** Without its 33 row and column. */
  template <int dim>
  VoigtMatrix<dim>
  in_plane(const VoigtMatrix<dim> &matrix);

  /** The least eigenvalue of a symmetric matrix relative to the largest
   * |entry|; with @p in_plane_only that of what is left without the 33 row. */
  template <int dim>
  double
  least_relative_eigenvalue(const VoigtMatrix<dim> &matrix,
                            const bool              in_plane_only);

  /** At which stress relaxes where the strain is held. Unit: 1/time. */
  struct RelaxationRates
  {
    double least   = 0.; ///< that is not 0; infinite if all are
    double largest = 0.;
    bool   all     = true; ///< no part of the stress does not relax
  };

  /** The extreme eigenvalues of H K, both symmetric and positive semidefinite;
   * in the plane only if the 33 row of K is zero. */
  template <int dim>
  RelaxationRates
  relaxation_rates(const VoigtMatrix<dim> &H, const VoigtMatrix<dim> &K);
} // namespace Crevasse

#endif
