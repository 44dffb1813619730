// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_boundary_roles_h
#define crevasse_parameters_boundary_roles_h

#include <crevasse/parameters/parameters.h>

#include <deal.II/base/point.h>
#include <deal.II/base/types.h>

#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace Crevasse
{
  /** Which boundary ids are clamped, symmetry planes, loaded and crack lips.
   * What is in none of them is free of traction. */
  struct BoundaryRoles
  {
    std::set<dealii::types::boundary_id> clamped;
    std::set<dealii::types::boundary_id> symmetry;
    std::set<dealii::types::boundary_id> loaded;
    std::set<dealii::types::boundary_id> contact;
  };

  /** A point where the named components of the displacement are zero. */
  template <int dim>
  struct FixedPoint
  {
    dealii::Point<dim>    point;
    std::array<bool, dim> components;
  };

  /** "x, y; x, y: 1" as points; components count from 1, and a point that
   * names none is fixed in all. "automatic" and "none" give no points.
   *
   * @throw SceneError that tells what is expected. */
  template <int dim>
  std::vector<FixedPoint<dim>>
  parse_fixed_points(const std::string &text);

  /** "1, 2" as a set, "none" or nothing as an empty set, and "automatic" as no
   * set at all.
   *
   * @throw SceneError that tells what is expected. */
  std::optional<std::set<dealii::types::boundary_id>>
  parse_boundary_ids(const std::string &text);

  /** What the user says wins: a role with a list of its own has this list, and
   * loses nothing to the automatic ones; an id in such a list is taken out of
   * the automatic lists of the other roles. */
  BoundaryRoles
  resolve_roles(const BoundaryParameters &parameters,
                const BoundaryRoles      &automatic);
} // namespace Crevasse

#endif
