// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_boundary_roles_h
#define crevasse_parameters_boundary_roles_h

#include <deal.II/base/point.h>
#include <deal.II/base/types.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

namespace Crevasse
{
  /** Boundary ids that are clamped, displaced, symmetry planes, loaded, and
   * crack lips.
   * Other boundaries are traction-free. Lips of contact touch rigid planes,
   * lips of a crack touch each other, and lips of an open crack never touch.
   * Lips may be loaded, too. */
  struct BoundaryRoles
  {
    std::set<dealii::types::boundary_id> clamped;
    std::set<dealii::types::boundary_id> displaced;
    /** Components of displaced boundaries that are not imposed. */
    std::set<std::pair<dealii::types::boundary_id, unsigned int>> free;
    std::set<dealii::types::boundary_id>                          symmetry;
    std::set<dealii::types::boundary_id>                          loaded;
    std::set<dealii::types::boundary_id>                          contact;
    std::set<dealii::types::boundary_id>                          crack;
    std::set<dealii::types::boundary_id>                          open;
    /** Whether x₁ = 0 is the axis of a body of revolution, where the radial
     * displacement vanishes. */
    bool has_axis = false;
    /** Whether lips that touch bear friction. */
    bool has_friction = false;

    bool
    has_contact() const
    {
      return !contact.empty() || !crack.empty();
    }

    bool
    has_lip() const
    {
      return has_contact() || !open.empty();
    }

    /** Whether a boundary is a lip that may touch. */
    bool
    touches(const dealii::types::boundary_id id) const
    {
      return contact.count(id) > 0 || crack.count(id) > 0;
    }

    bool
    is_lip(const dealii::types::boundary_id id) const
    {
      return touches(id) || open.count(id) > 0;
    }

    bool
    has_loaded_lip() const
    {
      return std::any_of(loaded.begin(), loaded.end(), [this](const auto id) {
        return is_lip(id);
      });
    }
  };

  /** Boundaries with one role, as a scene lists them. */
  struct BoundaryList
  {
    bool                                 is_automatic = false;
    std::set<dealii::types::boundary_id> ids;
    std::vector<std::string>             names; ///< names of physical groups
  };

  /** Parses a list of boundaries: "1, 2, upper lip", "none", or "automatic".
   *
   * @throw SceneError that says what is expected. */
  BoundaryList
  parse_boundary_list(const std::string &text);

  /** A point where the named components of the displacement are zero. */
  template <int dim>
  struct FixedPoint
  {
    dealii::Point<dim>    point;
    std::array<bool, dim> components;
  };

  /** Fixed points of a scene before the dimension is known. */
  struct FixedPointList
  {
    struct Entry
    {
      std::vector<double>    coordinates;
      std::set<unsigned int> components; ///< components from 1; empty: all
    };

    bool               is_automatic = false;
    std::vector<Entry> entries;
  };

  /** Parses fixed points: "x, y; x, y: 1", "none" or "automatic"; components
   * count from 1, and a point without components is fixed in all.
   *
   * @throw SceneError that says what is expected. */
  FixedPointList
  parse_fixed_points(const std::string &text);

  /** Fixed points in dim dimensions. @throw SceneError if they do not fit. */
  template <int dim>
  std::vector<FixedPoint<dim>>
  to_fixed_points(const FixedPointList &list);
} // namespace Crevasse

#endif
