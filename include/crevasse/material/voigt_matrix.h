// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_material_voigt_matrix_h
#define crevasse_material_voigt_matrix_h

#include <crevasse/material/voigt.h>

#include <complex>

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

  // (I + κ K H)⁻¹ K, for two symmetric matrices, positive semidefinite, and a κ
  // whose real part is not negative: what K bears where H gives way.
  template <int dim>
  VoigtMatrix<dim>
  relaxed_stiffness(const VoigtMatrix<dim> &K,
                    const VoigtMatrix<dim> &H,
                    const double            kappa);
  template <int dim>
  VoigtMatrix<dim, std::complex<double>>
  relaxed_stiffness(const VoigtMatrix<dim>    &K,
                    const VoigtMatrix<dim>    &H,
                    const std::complex<double> kappa);

  /** What is left of a stiffness where the strain 33 follows from s₃₃ = 0. */
  template <int dim>
  VoigtMatrix<dim>
  condense_thickness(const VoigtMatrix<dim> &matrix);

  /** Without its 33 row and column. */
  template <int dim>
  VoigtMatrix<dim>
  in_plane(const VoigtMatrix<dim> &matrix);

  /** The least eigenvalue of a symmetric matrix relative to the largest
   * |entry|; with @p in_plane_only of the matrix without row and column 33. */
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
