// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_boundary_roles_h
#define crevasse_parameters_boundary_roles_h

#include <deal.II/base/point.h>
#include <deal.II/base/types.h>

#include <array>
#include <set>
#include <string>
#include <vector>

namespace Crevasse
{
  /** Which boundary ids are clamped, symmetry planes, loaded and crack lips.
   * What is in none of them is free of traction. Lips of contact touch rigid
   * planes, those of a crack each other. */
  struct BoundaryRoles
  {
    std::set<dealii::types::boundary_id> clamped;
    std::set<dealii::types::boundary_id> symmetry;
    std::set<dealii::types::boundary_id> loaded;
    std::set<dealii::types::boundary_id> contact;
    std::set<dealii::types::boundary_id> crack;
    /** Whether x₁ = 0 is the axis of a body of revolution: no radial
     * displacement there, and hoops elsewhere. */
    bool has_axis = false;

    bool
    has_lip() const
    {
      return !contact.empty() || !crack.empty();
    }

    bool
    is_lip(const dealii::types::boundary_id id) const
    {
      return contact.count(id) > 0 || crack.count(id) > 0;
    }
  };

  /** The boundaries that a scene gives a role. */
  struct BoundaryList
  {
    bool                                 is_automatic = false;
    std::set<dealii::types::boundary_id> ids;
    std::vector<std::string>             names; ///< of physical groups
  };

  /** "1, 2, upper lip", "none", or "automatic".
   *
   * @throw SceneError that tells what is expected. */
  BoundaryList
  parse_boundary_list(const std::string &text);

  /** A point where the named components of the displacement are zero. */
  template <int dim>
  struct FixedPoint
  {
    dealii::Point<dim>    point;
    std::array<bool, dim> components;
  };

  /** As in a scene, whose dimension is another parameter. */
  struct FixedPointList
  {
    struct Entry
    {
      std::vector<double>    coordinates;
      std::set<unsigned int> components; ///< from 1; empty: all
    };

    bool               is_automatic = false;
    std::vector<Entry> entries;
  };

  /** "x, y; x, y: 1", "none" or "automatic"; components count from 1, and a
   * point that names none is fixed in all.
   *
   * @throw SceneError that tells what is expected. */
  FixedPointList
  parse_fixed_points(const std::string &text);

  /** @throw SceneError if there are other coordinates or components. */
  template <int dim>
  std::vector<FixedPoint<dim>>
  to_fixed_points(const FixedPointList &list);
} // namespace Crevasse

#endif
