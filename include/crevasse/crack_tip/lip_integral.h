// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_lip_integral_h
#define crevasse_crack_tip_lip_integral_h

#include <crevasse/crack_tip/lip_forces.h>
#include <crevasse/crack_tip/tip_region.h>
#include <crevasse/model/body.h>

namespace Crevasse
{
  /** Contribution ∫ 2 p q / √(2πr) ds of the pressure p on the lip to the
   * interaction integral for K_I. The shear traction of friction contributes
   * alike to K_II, with the forces along the tangents: see LipBasis.
   * Collective.
   * @param is_smooth whether the pressure is smooth at the tip: it is not where
   * a tip that has crept open is closed. */
  LipForces
  lip_integral(const Body<2>      &body,
               const TipRegion    &region,
               const SquareWeight &weight,
               const bool          is_smooth);

  /** Quadrature point on the lips of a tip. */
  struct LipPoint
  {
    dealii::types::boundary_id id;
    dealii::Point<2>           point;
    dealii::Point<2>           local;  ///< (X, Y), Y with the sign of the lip
    dealii::Tensor<1, 2>       normal; ///< outward
    double                     weight; ///< share of the lip's area
    double                     sign;   ///< TipRegion::sign_of_root()
  };

  /** This rank's points on the lips of a tip within a square of this size, for
   * integrals of smooth functions and of √r or 1/√r. */
  std::vector<LipPoint>
  lip_points(const Space<2> &space, const TipRegion &region, const double size);

  /** Work of forces on the lips as factors of the displacements, without those
   * that other ranks add. @param force at a point, times its weight. */
  Vector
  lip_work(const Space<2>                                              &space,
           const TipRegion                                             &region,
           const double                                                 size,
           const std::function<dealii::Tensor<1, 2>(const LipPoint &)> &force);
} // namespace Crevasse

#endif
