// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_grid_crack_tip_h
#define crevasse_grid_crack_tip_h

#include <crevasse/parameters/boundary_roles.h>

#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace Crevasse
{
  /** What is found at a tip: how the lips move apart, across the crack or along
   * it, and s₁₁ − s₂₂ of the constant stress beside the singular one: T, as
   * open lips have no s₂₂. */
  enum class CrackMode
  {
    opening, ///< K_I
    sliding, ///< K_II
    tearing, ///< K_III, in space
    constant ///< T
  };

  /** The end of a crack in the plane: where a face of the lip goes straight on
   * as a face of the plane of symmetry, or where the two lips of a crack meet.
   * Its own coordinates X and Y begin there; r and θ are their polar
   * coordinates, so that the upper lip is at θ = π, and the lower one at −π. */
  struct CrackTip
  {
    dealii::Point<2>     position;
    dealii::Tensor<1, 2> ahead;  ///< of X, along the crack
    dealii::Tensor<1, 2> inward; ///< of Y, into the body above the crack
    /** Whether the body is modelled on both sides of the crack. */
    bool two_lips = false;

    /** (X, Y) of a point. */
    dealii::Point<2>
    local(const dealii::Point<2> &point) const
    {
      const dealii::Tensor<1, 2> distance = point - position;
      return {distance * ahead, distance * inward};
    }

    /** (X, Y) of a point of a cell; on a lip Y has the sign of that lip,
     * whatever rounding makes of it.
     * @param beside another point of this cell, off the line of the crack. */
    dealii::Point<2>
    local(const dealii::Point<2> &point, const dealii::Point<2> &beside) const
    {
      dealii::Point<2> place = local(point);
      if (place[0] < 0. && (!two_lips || is_on_line(place)))
        place[1] = std::copysign(place[1], two_lips ? local(beside)[1] : 1.);
      return place;
    }

    /** Whether (X, Y) is on the line of the crack, but for rounding. */
    bool
    is_on_line(const dealii::Point<2> &local) const
    {
      return std::abs(local[1]) <=
             1e-8 * std::abs(local[0]) + 1e-14 * position.norm();
    }

    /** The rotation that makes (X, Y) components of those of the mesh. */
    dealii::Tensor<2, 2>
    to_local() const
    {
      dealii::Tensor<2, 2> rows;
      rows[0] = ahead;
      rows[1] = inward;
      return rows;
    }

    /** A vector with components along X and Y in the coordinates of the mesh.
     */
    dealii::Tensor<1, 2>
    global(const dealii::Tensor<1, 2> &vector) const
    {
      return vector[0] * ahead + vector[1] * inward;
    }
  };

  /** All tips of a mesh whose lips are straight there. Looks at the coarse
   * mesh, which every rank knows whole. */
  std::vector<CrackTip>
  find_crack_tips(const dealii::Triangulation<2> &mesh,
                  const BoundaryRoles            &roles);

  /** All tips if the lips at each are two, or else the one tip of a half model
   * that there must be.
   * @param wanted_by the parameter that asks for it, "[Section] Name = value".
   * @throw SceneError if there is none, or another one. */
  std::vector<CrackTip>
  crack_tips(const dealii::Triangulation<2> &mesh,
             const BoundaryRoles            &roles,
             const std::string              &wanted_by);

  /** Behind a tip with two lips, how far the crack goes straight on until its
   * line is in the body; infinite: it leaves the body, or the tip has one lip.
   * At most the distance of another tip. Looks at the coarse mesh. */
  double
  straight_length(const dealii::Triangulation<2> &mesh,
                  const BoundaryRoles            &roles,
                  const CrackTip                 &tip);

  /** Where faces of the lip go straight on as faces of the plane of symmetry in
   * the coarse mesh, and where two lips meet: both ends of each edge in space,
   * tips twice in the plane. */
  template <int dim>
  using CrackFront =
    std::vector<std::pair<dealii::Point<dim>, dealii::Point<dim>>>;

  template <int dim>
  CrackFront<dim>
  crack_front(const dealii::Triangulation<dim> &mesh,
              const BoundaryRoles              &roles);

  /** The distance of a point from an edge, which may have no length. */
  template <int dim>
  double
  distance_from_edge(const dealii::Point<dim> &point,
                     const dealii::Point<dim> &first,
                     const dealii::Point<dim> &last)
  {
    const dealii::Tensor<1, dim> along  = last - first;
    const double                 square = along.norm_square();
    const double where = square == 0. ? 0. : (point - first) * along / square;
    return point.distance(first + std::clamp(where, 0., 1.) * along);
  }

  /** An edge of the coarse mesh on the front of a crack in space, from its
   * first vertex to its last so that ahead = inward × (last − first). */
  struct FrontEdge
  {
    dealii::Point<3> first, last;
    /** Normal of the crack plane, into the body above the crack; of two lips
     * the one whose last component is positive that is not 0. */
    dealii::Tensor<1, 3> inward;
    bool                 two_lips;
  };

  std::vector<FrontEdge>
  oriented_crack_front(const dealii::Triangulation<3> &mesh,
                       const BoundaryRoles            &roles);
} // namespace Crevasse

#endif
