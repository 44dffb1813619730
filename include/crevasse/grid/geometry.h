// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_grid_geometry_h
#define crevasse_grid_geometry_h

#include <crevasse/grid/gmsh_file.h>
#include <crevasse/parameters/parameters.h>

#include <deal.II/grid/tria.h>

namespace Crevasse
{
  /** Numbers of cells of a mesh, which may exceed an integer. */
  struct CellCounts
  {
    double                   first;   ///< number of cells before refinement
    double                   all;     ///< number of cells after refinement
    std::vector<std::string> remarks; ///< on the mesh file, for the log
  };

  /**
   * Fills @p mesh with the built-in shape or the mesh file, and refines it
   * uniformly as often as the scene asks. A crack tip is always a vertex, a
   * straight crack front always a line of the mesh: if uniform cells do not
   * meet it, its two sides are divided separately.
   *
   * @param on_cell_count Called with the future numbers of cells before the
   * mesh is made; may throw.
   * @param named Groups of a Gmsh file that the scene names.
   * @throw SceneError if the mesh file cannot be used, or if the crack cannot
   * be resolved.
   */
  template <int dim>
  void
  make_mesh(const GeometryParameters                      &parameters,
            dealii::Triangulation<dim>                    &mesh,
            const std::function<void(const CellCounts &)> &on_cell_count = {},
            const NamedGroups                             &named         = {});
} // namespace Crevasse

#endif
