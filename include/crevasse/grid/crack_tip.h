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
  /** Modes of the field at a crack tip: how the lips move apart, across or
   * along the crack, and T = s₁₁ − s₂₂ of the constant stress beside the
   * singular one, as open lips have no s₂₂. */
  enum class CrackMode
  {
    opening, ///< mode I, with K_I
    sliding, ///< mode II, with K_II
    tearing, ///< mode III, with K_III, in space
    constant ///< constant stress T
  };

  /** Tip of a crack in the plane: where a face of the lip continues straight as
   * a face of the plane of symmetry, or where the two lips of a crack meet.
   * Its local coordinates X and Y begin there; r and θ are their polar
   * coordinates, so that the upper lip is at θ = π, and the lower lip at −π. */
  struct CrackTip
  {
    dealii::Point<2>     position;
    dealii::Tensor<1, 2> ahead; ///< direction of X, along the crack
    dealii::Tensor<1, 2>
      inward; ///< direction of Y, into the body above the crack
    /** Whether the body is modelled on both sides of the crack. */
    bool two_lips = false;
    /** Whether the lips never touch. */
    bool is_open = false;
    /** Curvature of the lips at the tip: the centre of their circle is at (0,
     * 1/curvature). */
    double curvature = 0.;

    /** Local coordinates (X, Y) of a point. */
    dealii::Point<2>
    local(const dealii::Point<2> &point) const
    {
      const dealii::Tensor<1, 2> distance = point - position;
      return {distance * ahead, distance * inward};
    }

    /** Local coordinates (X, Y) of a point of a cell; on a lip, Y has the sign
     * of this lip in spite of rounding.
     * @param beside Another point of the cell, off the line of the crack. */
    dealii::Point<2>
    local(const dealii::Point<2> &point, const dealii::Point<2> &beside) const
    {
      dealii::Point<2> place = local(point);
      if (place[0] < 0. && (!two_lips || is_on_line(place)))
        place[1] = std::copysign(place[1], two_lips ? local(beside)[1] : 1.);
      return place;
    }

    /** Whether (X, Y) is on the line of the crack, up to rounding. */
    bool
    is_on_line(const dealii::Point<2> &local) const
    {
      return std::abs(local[1]) <=
             1e-8 * std::abs(local[0]) + 1e-14 * position.norm();
    }

    /** Height of (X, Y) above the straight line or circle of the lips at the
     * tip, up to higher powers of it. */
    double
    height(const dealii::Point<2> &local) const
    {
      return local[1] - 0.5 * curvature * local.square();
    }

    /** Whether (X, Y) is on this line or circle, as exactly as files have
     * nodes. */
    bool
    is_on_curve(const dealii::Point<2> &local) const
    {
      return curvature == 0.
               ? is_on_line(local)
               : std::abs(height(local)) <=
                   std::min(1e-5 * local.norm(), 1e-6 / std::abs(curvature));
    }

    /** Distance of a point (X, Y) of this line or circle along it. */
    double
    length_to(const dealii::Point<2> &local) const
    {
      const double chord = local.norm();
      const double sine  = 0.5 * std::abs(curvature) * chord;
      return sine < 1e-4 ? chord * (1. + sine * sine / 6.)
                         : chord * std::asin(std::min(sine, 1.)) / sine;
    }

    /** Rotation of components from the mesh's coordinates to (X, Y). */
    dealii::Tensor<2, 2>
    to_local() const
    {
      dealii::Tensor<2, 2> rows;
      rows[0] = ahead;
      rows[1] = inward;
      return rows;
    }

    /** Components in the mesh's coordinates of a vector along X and Y. */
    dealii::Tensor<1, 2>
    global(const dealii::Tensor<1, 2> &vector) const
    {
      return vector[0] * ahead + vector[1] * inward;
    }
  };

  /** Finds all crack tips of a mesh with straight lips. Uses the coarse mesh,
   * which every rank knows completely. */
  std::vector<CrackTip>
  find_crack_tips(const dealii::Triangulation<2> &mesh,
                  const BoundaryRoles            &roles);

  /** All crack tips of a model with two lips, or the one tip that a half model
   * must have.
   * @param wanted_by Parameter that needs the tips, "[Section] Name = value".
   * @throw SceneError if there is no tip, or a wrong one. */
  std::vector<CrackTip>
  crack_tips(const dealii::Triangulation<2> &mesh,
             const BoundaryRoles            &roles,
             const std::string              &wanted_by);

  /** Length over which the crack is straight behind a tip with two lips, at
   * most the distance to another tip; infinite if its line leaves the body, or
   * the tip has one lip. Uses the coarse mesh. */
  double
  straight_length(const dealii::Triangulation<2> &mesh,
                  const BoundaryRoles            &roles,
                  const CrackTip                 &tip);

  /** Crack front in the coarse mesh, where lip faces continue straight as faces
   * of the plane of symmetry or two lips meet: both ends of each edge in
   * space, each tip twice in the plane. */
  template <int dim>
  using CrackFront =
    std::vector<std::pair<dealii::Point<dim>, dealii::Point<dim>>>;

  template <int dim>
  CrackFront<dim>
  crack_front(const dealii::Triangulation<dim> &mesh,
              const BoundaryRoles              &roles);

  /** Distance of a point from an edge, which may have length 0. */
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

  /** Edge of the coarse mesh on a crack front in space, oriented so that ahead
   * = inward × (last − first). */
  struct FrontEdge
  {
    dealii::Point<3> first, last;
    /** Normal of the crack plane, into the body above the crack; with two lips,
     * the normal whose last non-zero component is positive. */
    dealii::Tensor<1, 3> inward;
    bool                 two_lips;
  };

  std::vector<FrontEdge>
  oriented_crack_front(const dealii::Triangulation<3> &mesh,
                       const BoundaryRoles            &roles);
} // namespace Crevasse

#endif
