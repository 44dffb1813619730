// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

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
