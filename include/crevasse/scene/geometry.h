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

#include <crevasse/scene/boundary_roles.h>
#include <crevasse/scene/parameters.h>

#include <deal.II/grid/tria.h>

#include <vector>

namespace Crevasse
{
  /** Boundary ids of the built-in shapes. The bottom is the crack plane x₂ = 0:
   * `ligament` where the body goes on below it, `lip` along the crack. */
  namespace BoundaryIds
  {
    constexpr dealii::types::boundary_id left     = 0;
    constexpr dealii::types::boundary_id right    = 1;
    constexpr dealii::types::boundary_id ligament = 2;
    constexpr dealii::types::boundary_id top      = 3;
    constexpr dealii::types::boundary_id lip      = 4;
  } // namespace BoundaryIds

  /**
   * Fills @p mesh with the built-in shape or the mesh file, and refines it
   * uniformly as often as the scene asks. A crack tip always is a vertex: where
   * uniform cells do not meet it, the two sides of it are divided separately.
   *
   * @throw SceneError if the file cannot be understood as a mesh of
   * quadrilaterals (hexahedra), or if the crack cannot be resolved.
   */
  template <int dim>
  void
  make_mesh(const GeometryParameters   &parameters,
            dealii::Triangulation<dim> &mesh);

  /** The roles that a built-in shape gives its boundary ids; none for a mesh
   * file. */
  BoundaryRoles
  built_in_roles(const GeometryParameters &parameters);

  /** The points that a built-in shape must hold so that no rigid motion is
   * left: none where symmetry planes do so already. */
  template <int dim>
  std::vector<FixedPoint<dim>>
  built_in_fixed_points(const GeometryParameters &parameters);
} // namespace Crevasse

#endif
