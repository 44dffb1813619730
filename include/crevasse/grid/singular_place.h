// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_grid_singular_place_h
#define crevasse_grid_singular_place_h

#include <crevasse/parameters/boundary_roles.h>

#include <deal.II/grid/tria.h>

#include <string>

namespace Crevasse
{
  /** Says why no mesh bounds the stress of a body, and what to judge instead,
   * for a body with a crack or, in the plane, with a re-entrant corner between
   * straight sides of more than 225 degrees; empty for other bodies. Uses the
   * coarse mesh, which every rank knows completely. */
  template <int dim>
  std::string
  why_stress_is_unbounded(const dealii::Triangulation<dim> &mesh,
                          const BoundaryRoles              &roles);
} // namespace Crevasse

#endif
