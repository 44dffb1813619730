// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_material_plane_elasticity_h
#define crevasse_material_plane_elasticity_h

#include <crevasse/material/voigt.h>

#include <deal.II/base/tensor.h>

namespace Crevasse
{
  /**
   * An isotropic elastic body in the plane, in plane stress and plane strain
   * alike: σ = λ tr ε I + 2μ ε for the four components in the plane. With the
   * viscosity for the stiffness it is a viscous one, and its displacements are
   * velocities.
   */
  class PlaneElasticity
  {
  public:
    /** @param stiffness for which is_isotropic() holds. */
    explicit PlaneElasticity(const VoigtMatrix<2> &stiffness);

    /** Whether all directions in the plane are alike; what happens across it
     * does not matter. */
    static bool
    is_isotropic(const VoigtMatrix<2> &stiffness);

    /** A compliance or fluidity, whose shears are engineering ones, in the form
     * of a stiffness: isotropic if that is. */
    static VoigtMatrix<2>
    like_stiffness(const VoigtMatrix<2> &compliance);

    /** μ */
    double
    shear_modulus() const
    {
      return mu;
    }

    /** κ = (λ + 3μ)/(λ + μ): 3 − 4ν in plane strain, (3 − ν)/(1 + ν) in plane
     * stress. */
    double
    kappa() const;

    /** E' = 8μ/(κ + 1): E in plane stress, E/(1 − ν²) in plane strain. */
    double
    modulus() const;

    /** σ of a displacement gradient, and of a dilatation that may not be its
     * trace (see VolumetricStrain::mean). */
    dealii::Tensor<2, 2>
    stress(const dealii::Tensor<2, 2> &gradient, const double dilatation) const;

    dealii::Tensor<2, 2>
    stress(const dealii::Tensor<2, 2> &gradient) const;

  private:
    double lambda, mu;
  };
} // namespace Crevasse

#endif
