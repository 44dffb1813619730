// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_grid_corner_angles_h
#define crevasse_grid_corner_angles_h

#include <deal.II/grid/tria.h>

#include <map>

namespace Crevasse
{
  /** Angles within the body at the vertices of its boundary, by vertex index,
   * but for vertices of curved sides: 2π at a tip between two lips. Uses the
   * coarse mesh, which every rank knows completely. */
  std::map<unsigned int, double>
  corner_angles(const dealii::Triangulation<2> &mesh);
} // namespace Crevasse

#endif
