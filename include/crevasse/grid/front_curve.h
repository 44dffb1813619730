// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_grid_front_curve_h
#define crevasse_grid_front_curve_h

#include <crevasse/grid/crack_tip.h>

namespace Crevasse
{
  /** Coordinates of a point around a crack front: the nearest point of the
   * front, X ahead in the plane of the crack, and Y into the body above it. The
   * triad is right-handed, ahead × inward = tangent. */
  struct FrontFrame
  {
    unsigned int         chain = 0;  ///< index of the front
    double               s     = 0.; ///< arc length
    double               X = 0., Y = 0.;
    dealii::Tensor<1, 3> ahead, inward, tangent;
    double               curvature = 0.; ///< k in d ahead/ds = k tangent
    /** k in d inward/ds = k tangent; 0 for a plane crack. */
    double normal_curvature = 0.;

    /** Length along a line at constant X, Y per length along the front. */
    double
    metric() const
    {
      return 1. + curvature * X + normal_curvature * Y;
    }

    double
    distance() const
    {
      return std::hypot(X, Y);
    }
  };

  /**
   * The fronts of plane cracks in space as smooth curves: cubic polynomials
   * between the vertices of the coarse mesh and middles of curved edges. The
   * tangent there is that of the polynomial through two neighbours on each
   * side. Straight fronts are exact. A front is closed or ends at the boundary
   * of the body.
   */
  class FrontCurve
  {
  public:
    /** Finds the fronts in the coarse mesh, which every rank knows whole.
     * @param wanted_by the parameter that needs fronts.
     * @throw SceneError if there is no front, if a front branches, leaves its
     * plane or does not meet a face at a right angle, or if some cracks have
     * two lips and others one. */
    FrontCurve(const dealii::Triangulation<3> &mesh,
               const BoundaryRoles            &roles,
               const std::string              &wanted_by);

    FrontFrame
    frame(const dealii::Point<3> &point) const;

    struct Chain
    {
      bool                          is_closed = false;
      dealii::Tensor<1, 3>          inward;
      std::vector<dealii::Point<3>> points; ///< points; closed: first = last
      std::vector<dealii::Tensor<1, 3>> tangents; ///< unit tangents at points
      std::vector<double>               arcs;     ///< arc lengths s of points

      double
      length() const
      {
        return arcs.back();
      }

      unsigned int
      n_segments() const
      {
        return points.size() - 1;
      }
    };

    /** Whether the body is modelled on both sides of every crack. */
    bool two_lips = false;

    const std::vector<Chain> &
    chains() const
    {
      return all;
    }

    /** Distance up to which each point has a single nearest point on the
     * fronts: the radius of curvature, or half the distance of two fronts. */
    double
    reach() const;

  private:
    std::vector<Chain> all;
    const std::string  wanted_by;

    void
    join(const std::vector<FrontEdge> &edges);
    /** Adds the middles of second-order edges to the points of a front. Those
     * of a polygon are not on the curve for which it stands. */
    static void
    add_middles(Chain &chain, const dealii::Triangulation<3> &mesh);
    void
    set_tangents(Chain &chain, const dealii::Triangulation<3> &mesh) const;
    dealii::Tensor<1, 3>
    tangent_at_end(const Chain                    &chain,
                   const bool                      at_begin,
                   const dealii::Triangulation<3> &mesh) const;
  };

  /**
   * Moves the middles of a mesh's curved edges on fronts, so that the front
   * has one tangent at each vertex: that of the FrontCurve. Edges of second
   * order are parabolas, and where they meet at an angle K is wrong: 1.8 % at
   * an ellipse of 2 : 1 with 6 edges along a quarter, 0.3 % without angles. The
   * middle of a parabola is the mean of the middle of its chord and of the
   * point where its tangents meet. Edges that would turn by less than 1e-3, or
   * whose middle would move by more than 3 % of the chord, or far for the size
   * of the cells there, stay, as all do of fronts that FrontCurve refuses.
   * @return the largest move, relative to the chord.
   */
  double
  smooth_fronts(dealii::Triangulation<3> &mesh, const BoundaryRoles &roles);
} // namespace Crevasse

#endif
