// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_lip_integral_h
#define crevasse_crack_tip_lip_integral_h

#include <crevasse/crack_tip/tip_region.h>
#include <crevasse/model/body.h>

namespace Crevasse
{
  /** Contribution ∫ 2 p q / √(2πr) ds of the pressure p on the lip to the
   * interaction integral for K_I, as factors of the contact forces of the lip's
   * local nodes. The shear traction of friction contributes alike to K_II, with
   * the forces along the tangents: see LipBasis.
   *
   * In the cells at a tip whose lips slide the stress of K_II is as wrong as it
   * is large. Unless both sides have mirrored meshes, so is the pressure: its
   * mean over a cell of size h by about K_II/√h, which contributes alike on all
   * meshes. But displacements at a distance from the tip are right, and the
   * pressure is smooth: from there the straight line of least squares (of
   * pressures with the areas of their nodes) continues it to the tip. It begins
   * elsewhere in squares of other sizes, so that their difference shows what is
   * left.
   */
  class LipIntegral
  {
  public:
    LipIntegral() = default;

    /** Collective.
     * @param is_smooth whether the pressure is smooth at the tip: it is not
     * where a tip that has crept open is closed. */
    LipIntegral(const Body<2>      &body,
                const TipRegion    &region,
                const SquareWeight &weight,
                const bool          is_smooth);

    /** Contribution of normal or tangential forces of the lip's local nodes.
     * Collective.
     * @param normal normal forces: half of the nodes from which the line is
     * continued must be closed. */
    double
    value(const std::vector<double> &forces,
          const std::vector<double> &normal) const;

    /** Factors of the forces, with the line. */
    const std::vector<double> &
    factors_of_forces() const
    {
      return of_line;
    }

    /** Multiplies the contribution. */
    void
    scale(const double factor);

  private:
    MPI_Comm                 communicator = MPI_COMM_SELF;
    std::vector<double>      factors; ///< of the forces
    std::vector<double>      of_line; ///< likewise, with the line at the tip
    std::vector<std::size_t> on_line; ///< local nodes that decide on the line
  };

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
