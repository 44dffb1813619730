// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_grid_geometry_h
#define crevasse_grid_geometry_h

#include <crevasse/parameters/parameters.h>

#include <deal.II/grid/tria.h>

namespace Crevasse
{
  /** Numbers of cells that are not bound to fit into an integer. */
  struct CellCounts
  {
    double first; ///< before refinement
    double all;   ///< after it
  };

  /**
   * Fills @p mesh with the built-in shape or the mesh file, and refines it
   * uniformly as often as the scene asks. A crack tip always is a vertex, a
   * straight crack front a line of the mesh: where uniform cells do not meet
   * it, the two sides of it are divided separately.
   *
   * @param on_cell_count sees how many cells there are going to be while there
   * is no more than a file that was read; it may throw.
   * @param cracks boundary ids along which a Gmsh file's mesh is cut.
   * @throw SceneError if the file cannot be understood as a mesh of
   * quadrilaterals (hexahedra), or if the crack cannot be resolved.
   */
  template <int dim>
  void
  make_mesh(const GeometryParameters                      &parameters,
            dealii::Triangulation<dim>                    &mesh,
            const std::function<void(const CellCounts &)> &on_cell_count = {},
            const std::set<unsigned int>                  &cracks        = {});
} // namespace Crevasse

#endif
