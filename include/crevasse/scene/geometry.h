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

#ifndef crevasse_scene_geometry_h
#define crevasse_scene_geometry_h

#include <crevasse/scene/parameters.h>

#include <deal.II/grid/tria.h>

namespace Crevasse
{
  /**
   * Fills @p mesh with the built-in shape or the mesh file, and refines it
   * uniformly as often as the scene asks. A crack tip always is a vertex, a
   * straight crack front a line of the mesh: where uniform cells do not meet
   * it, the two sides of it are divided separately.
   *
   * @throw SceneError if the file cannot be understood as a mesh of
   * quadrilaterals (hexahedra), or if the crack cannot be resolved.
   */
  template <int dim>
  void
  make_mesh(const GeometryParameters   &parameters,
            dealii::Triangulation<dim> &mesh);
} // namespace Crevasse

#endif
