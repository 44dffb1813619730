// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_material_plane_elasticity_h
#define crevasse_material_plane_elasticity_h

#include <crevasse/material/voigt.h>

#include <cmath>

namespace Crevasse
{
  /**
   * Isotropic elasticity in plane stress or plane strain: σ = λ tr ε I + 2μ ε
   * for the four components in the plane. With a viscosity as stiffness the
   * body is viscous, and displacements are velocities.
   */
  class PlaneElasticity
  {
  public:
    /** @param stiffness must satisfy is_isotropic(). */
    explicit PlaneElasticity(const VoigtMatrix<2> &stiffness)
      : shear_modulus(stiffness[3][3])
      , lambda(stiffness[0][1])
    {
    }

    /** Whether a stiffness is isotropic in the plane; entries of the third
     * direction are ignored. */
    static bool
    is_isotropic(const VoigtMatrix<2> &stiffness)
    {
      constexpr double tolerance = 1e-10; // a viscosity is an inverse
      const double     rounding  = tolerance * std::abs(stiffness[0][0]);
      const auto       vanishes  = [rounding](const double difference) {
        return std::abs(difference) <= rounding;
      };
      return vanishes(stiffness[0][0] - stiffness[1][1]) &&
             vanishes(stiffness[0][3]) && vanishes(stiffness[1][3]) &&
             vanishes(stiffness[0][0] - stiffness[0][1] - 2. * stiffness[3][3]);
    }

    /** Compliance or fluidity (with engineering shears), scaled so that
     * is_isotropic() applies. */
    static VoigtMatrix<2>
    like_stiffness(const VoigtMatrix<2> &compliance)
    {
      // 1/μ for 4 × 1/(4μ)
      VoigtMatrix<2> matrix = compliance;
      matrix[3][3] /= 4.;
      return matrix;
    }

    /** Shear modulus μ. */
    double shear_modulus;

    /** κ = (λ + 3μ)/(λ + μ): 3 − 4ν in plane strain, (3 − ν)/(1 + ν) in plane
     * stress. */
    double
    kappa() const
    {
      return (lambda + 3. * shear_modulus) / (lambda + shear_modulus);
    }

    /** E' = 8μ/(κ + 1): E in plane stress, E/(1 − ν²) in plane strain. */
    double
    modulus() const
    {
      return 8. * shear_modulus / (kappa() + 1.);
    }

    /** Strain caused by a stress in the plane, with engineering shears. */
    VoigtVector<2>
    strain(const VoigtVector<2> &s) const
    {
      const double   nu = (3. - kappa()) / 4.;
      VoigtVector<2> e;
      e[0] = (s[0] - nu * (s[0] + s[1])) / (2. * shear_modulus);
      e[1] = (s[1] - nu * (s[0] + s[1])) / (2. * shear_modulus);
      e[3] = 2. * s[3] / (2. * shear_modulus);
      return e;
    }

    /** Strain caused by a stress with a third normal component, including the
     * strain 33; not for plane stress. */
    VoigtVector<2>
    strain_with_hoops(const VoigtVector<2> &s) const
    {
      const double   nu = (3. - kappa()) / 4., trace = s[0] + s[1] + s[2];
      VoigtVector<2> e;
      for (unsigned int d = 0; d < 3; ++d)
        e[d] = (s[d] - nu / (1. + nu) * trace) / (2. * shear_modulus);
      e[3] = s[3] / shear_modulus;
      return e;
    }

  private:
    double lambda;
  };
} // namespace Crevasse

#endif
