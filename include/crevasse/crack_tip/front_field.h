// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_front_field_h
#define crevasse_crack_tip_front_field_h

#include <crevasse/crack_tip/auxiliary_field.h>
#include <crevasse/grid/front_curve.h>

namespace Crevasse
{
  /** Moduli of an isotropic body at a crack front, without the factor k. */
  struct FrontElasticity
  {
    double young_modulus, poisson_ratio;

    /** Modulus M of K² = M G: E' = E/(1 − ν²), or 2μ = E/(1 + ν) for K_III. */
    double
    modulus(const CrackMode mode) const
    {
      return young_modulus /
             (1. - poisson_ratio *
                     (mode == CrackMode::tearing ? -1. : poisson_ratio));
    }
  };

  /** Factors of FrontIntegral at a point, in coordinates of the mesh. */
  struct FrontField
  {
    VoigtVector<3>       of_stress; ///< M (ε(w) − S τ), shears twofold
    VoigtVector<3>       of_strain; ///< factor M τ of strain
    dealii::Tensor<1, 3> of_force;  ///< factor M w of force

    void
    add(const double factor, const FrontField &other)
    {
      of_stress += factor * other.of_stress;
      of_strain += factor * other.of_strain;
      of_force += factor * other.of_force;
    }
  };

  /** Auxiliary fields of FrontIntegral for one mode; halved around fronts with
   * two lips. */
  struct FrontFields
  {
    CrackMode       mode;
    bool            two_lips;
    FrontElasticity elasticity;
    SquareWeight    weight;

    /** Auxiliary fields at a place for the hat function h = 1, and for its
     * slope along the front. @param frame not on the front. */
    std::pair<FrontField, FrontField>
    at(const FrontFrame &frame) const;

    /** Displacement M u^B, along ahead, inward and tangent. On the lips, Y =
     * ±0, the sign of Y tells the lip. */
    dealii::Tensor<1, 3>
    displacement(const FrontFrame &frame) const;

  private:
    /** Parts of τ, along ahead, inward and tangent: τ = Q σ^B + rest for h = 1,
     * and the factor of the slope of h. */
    struct Stress
    {
      dealii::SymmetricTensor<2, 3> of_field, rest, of_slope;
      /** Stress of ε^B along the front times Q, which τ does not contain. */
      double along_front = 0.;
    };

    Stress
    plane(const FrontFrame &frame) const;
    Stress
    antiplane(const FrontFrame &frame) const;
  };

  /** Converts a symmetric tensor with components along ahead, inward and
   * tangent to a vector in the coordinates of the mesh.
   * @param of_shear factor of shears. */
  VoigtVector<3>
  to_mesh(const FrontFrame                    &frame,
          const dealii::SymmetricTensor<2, 3> &local,
          const double                         of_shear);
} // namespace Crevasse

#endif
