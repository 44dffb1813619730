// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_model_mesh_room_h
#define crevasse_model_mesh_room_h

#include <crevasse/grid/geometry.h>
#include <crevasse/parameters/scene.h>

#include <deal.II/base/mpi.h>

namespace Crevasse
{
  /** Looks before a mesh is made whether it can be computed on: making one that
   * cannot takes minutes, or all memory. Counts what surely is needed, mesh and
   * linear solver; describe_memory() knows more, once there is a mesh.
   * Collective.
   * @throw SceneError if the machine has less than that left, or the linear
   * solver can do with fewer unknowns only. */
  template <int dim>
  void
  require_room(const Scene      &scene,
               const CellCounts &cells,
               const MPI_Comm    communicator);
} // namespace Crevasse

#endif
