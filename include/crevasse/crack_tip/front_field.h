// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_front_field_h
#define crevasse_crack_tip_front_field_h

#include <crevasse/crack_tip/auxiliary_field.h>
#include <crevasse/crack_tip/front_curve.h>

namespace Crevasse
{
  /** The moduli of an isotropic body at a crack front, without the factor k. */
  struct FrontElasticity
  {
    double young_modulus, poisson_ratio;

    /** M of K² = M G: E' = E/(1 − ν²), and 2μ = E/(1 + ν) of K_III. */
    double
    modulus(const CrackMode mode) const
    {
      return young_modulus /
             (1. - poisson_ratio *
                     (mode == CrackMode::tearing ? -1. : poisson_ratio));
    }
  };

  /** What FrontIntegral multiplies at a point, in the coordinates of the mesh.
   */
  struct FrontField
  {
    VoigtVector<3>       of_stress; ///< M (ε(w) − S τ), with shears twofold
    VoigtVector<3>       of_strain; ///< M τ
    dealii::Tensor<1, 3> of_force;  ///< M w

    void
    add(const double factor, const FrontField &other)
    {
      of_stress += factor * other.of_stress;
      of_strain += factor * other.of_strain;
      of_force += factor * other.of_force;
    }
  };

  /** The auxiliary fields of FrontIntegral for one mode; half of them around
   * fronts with two lips. */
  struct FrontFields
  {
    CrackMode       mode;
    bool            two_lips;
    FrontElasticity elasticity;
    SquareWeight    weight;

    /** For h = 1 and for its slope. @param frame not on the front. */
    std::pair<FrontField, FrontField>
    at(const FrontFrame &frame) const;

    /** M u^B, along ahead, inward and tangent. Where Y = ±0 its sign tells the
     * lip. */
    dealii::Tensor<1, 3>
    displacement(const FrontFrame &frame) const;

  private:
    /** τ in parts, along ahead, inward and tangent: τ = Q σ^B + rest for h = 1,
     * and of its slope. */
    struct Stress
    {
      dealii::SymmetricTensor<2, 3> of_field, rest, of_slope;
      /** That along the front in the stress of ε^B, which τ has not, times Q.
       */
      double along_front = 0.;
    };

    Stress
    plane(const FrontFrame &frame) const;
    Stress
    antiplane(const FrontFrame &frame) const;
  };

  /** A symmetric tensor with components along ahead, inward and tangent as a
   * vector in the coordinates of the mesh.
   * @param of_shear by what shears are multiplied. */
  VoigtVector<3>
  to_mesh(const FrontFrame                    &frame,
          const dealii::SymmetricTensor<2, 3> &local,
          const double                         of_shear);
} // namespace Crevasse

#endif
