// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_mesh_picture_h
#define crevasse_simulation_mesh_picture_h

#include <crevasse/base/summary.h>
#include <crevasse/grid/mesh.h>
#include <crevasse/parameters/scene.h>

namespace Crevasse
{
  /**
   * What crevasse/picture.py shows of a scene before a run: cells, faces of the
   * boundary, names, roles, supports, probes and crack fronts.
   *
   * @param mesh of one process.
   * @throw SceneError as boundary_roles() and fixed_points() do. */
  template <int dim>
  Summary
  mesh_picture(const Scene &scene, const Mesh<dim> &mesh);
} // namespace Crevasse

#endif
