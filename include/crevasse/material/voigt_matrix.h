// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_material_voigt_matrix_h
#define crevasse_material_voigt_matrix_h

#include <crevasse/material/voigt.h>

#include <complex>

namespace Crevasse
{
  // Linear algebra of the small matrices of a material. In plane stress row and
  // column 33 of a stiffness or viscosity are zero; "in the plane" means
  // without them.

  /** Inverse of a symmetric matrix, in the plane if row 33 is zero.
   * @throw NumericalError if it is singular. */
  template <int dim>
  VoigtMatrix<dim>
  inverse(const VoigtMatrix<dim> &matrix);

  /** Stiffness (I + κ K H)⁻¹ K after relaxation by the fluidity H. K and H
   * are symmetric and positive semidefinite; the real part of κ, real or
   * complex, is not negative. A complex κ may be infinite, for what remains. */
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

  /** Plane-stress stiffness: eliminates the strain 33 by s₃₃ = 0. */
  template <int dim>
  VoigtMatrix<dim>
  condense_thickness(const VoigtMatrix<dim> &matrix);

  /** Copy of a matrix with row and column 33 set to zero. */
  template <int dim>
  VoigtMatrix<dim>
  in_plane(const VoigtMatrix<dim> &matrix);

  /** Least eigenvalue of a symmetric matrix relative to its largest |entry|;
   * without row and column 33 if @p in_plane_only. */
  template <int dim>
  double
  least_relative_eigenvalue(const VoigtMatrix<dim> &matrix,
                            const bool              in_plane_only);

  /** Rates at which stress relaxes at constant strain. Unit: 1/time. */
  struct RelaxationRates
  {
    double least   = 0.; ///< least nonzero rate; infinite if all are zero
    double largest = 0.;
    bool   all     = true; ///< whether all of the stress relaxes
  };

  /** Extreme eigenvalues of H K, for symmetric positive semidefinite H and K;
   * in the plane if row 33 of K is zero. */
  template <int dim>
  RelaxationRates
  relaxation_rates(const VoigtMatrix<dim> &H, const VoigtMatrix<dim> &K);

  /**
   * Stiffness of an isotropic body in plane stress (33 row and column zero),
   * plane strain or three dimensions.
   */
  template <int dim>
  VoigtMatrix<dim>
  isotropic_stiffness(const double young_modulus,
                      const double poisson_ratio,
                      const bool   plane_stress);

  /** Inverse of the three-dimensional isotropic stiffness; defined up to the
   * Poisson ratio ½ inclusive (purely deviatoric). */
  template <int dim>
  VoigtMatrix<dim>
  isotropic_compliance(const double young_modulus, const double poisson_ratio);

  /** Whether a matrix, with or without row and column 33, has the eigenvectors
   * of an isotropic one, as with cubic symmetry: equal entries for all
   * directions, equal entries for all shears, and no coupling of both. */
  template <int dim>
  bool
  is_isotropic(const VoigtMatrix<dim> &matrix);

  /** Functions φ₁(z) = (e^z − 1)/z and φ₂(z) = (φ₁(z) − 1)/z of exponential
   * integrators, of a matrix z. */
  template <int dim>
  struct PhiFunctions
  {
    VoigtMatrix<dim> first, second;
  };

  /** Computes φ₁ and φ₂ of −@p rate. The eigenvalues of @p rate must be real
   * and not negative, as for HK. Taylor series of a fraction 2⁻ⁿ and n
   * doublings need no eigenvectors or inverse, and lose no digits, since all
   * terms are positive. @throw NumericalError if @p rate is not finite. */
  template <int dim>
  PhiFunctions<dim>
  decay_functions(const VoigtMatrix<dim> &rate);
} // namespace Crevasse

#endif
