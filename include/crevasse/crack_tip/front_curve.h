// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_front_curve_h
#define crevasse_crack_tip_front_curve_h

#include <crevasse/grid/crack_tip.h>

namespace Crevasse
{
  /** The coordinates around a crack front: of the nearest point of it, and
   * there X ahead in the plane of the crack and Y into the body above it. The
   * triad is right-handed, ahead × inward = tangent. */
  struct FrontFrame
  {
    unsigned int         chain = 0;  ///< which front
    double               s     = 0.; ///< arc length
    double               X = 0., Y = 0.;
    dealii::Tensor<1, 3> ahead, inward, tangent;
    double               curvature = 0.; ///< k of d ahead/ds = k tangent

    /** Length along a line at constant X, Y by length along the front. */
    double
    metric() const
    {
      return 1. + curvature * X;
    }

    double
    distance() const
    {
      return std::hypot(X, Y);
    }
  };

  /**
   * The fronts of plane cracks in space as smooth curves: cubic polynomials
   * between the vertices of the coarse mesh, with the tangent of the circle
   * through a vertex and its neighbours. The error of an arc is of order 6 in
   * its angle, of straight fronts there is none. A front is closed or ends at
   * the boundary of the body.
   */
  class FrontCurve
  {
  public:
    /** Looks at the coarse mesh, which every rank knows whole.
     * @param wanted_by the parameter that asks for it.
     * @throw SceneError if there is no front, or one that branches, leaves its
     * plane or meets a face at another angle than a right one, or if some
     * cracks have two lips and others one. */
    FrontCurve(const dealii::Triangulation<3> &mesh,
               const BoundaryRoles            &roles,
               const std::string              &wanted_by);

    FrontFrame
    frame(const dealii::Point<3> &point) const;

    struct Chain
    {
      bool                              is_closed = false;
      dealii::Tensor<1, 3>              inward;
      std::vector<dealii::Point<3>>     points;   ///< closed: first = last
      std::vector<dealii::Tensor<1, 3>> tangents; ///< at these, unit vectors
      std::vector<double>               arcs;     ///< s of these

      double
      length() const
      {
        return arcs.back();
      }
    };

    /** Of all cracks: whether the body is modelled on both sides. */
    bool two_lips = false;

    const std::vector<Chain> &
    chains() const
    {
      return all;
    }

    /** Up to which distance, at least, each point has one nearest point of the
     * fronts: the radius of curvature, or half the distance of two fronts. */
    double
    reach() const;

  private:
    std::vector<Chain> all;
    const std::string  wanted_by;

    void
    join(const std::vector<FrontEdge> &edges);
    void
    set_tangents(Chain &chain, const dealii::Triangulation<3> &mesh) const;
    dealii::Tensor<1, 3>
    tangent_at_end(const Chain                    &chain,
                   const bool                      at_begin,
                   const dealii::Triangulation<3> &mesh) const;
  };
} // namespace Crevasse

#endif
