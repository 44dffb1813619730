// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_grid_gmsh_file_h
#define crevasse_grid_gmsh_file_h

#include <crevasse/grid/mesh_faces.h>

#include <deal.II/base/point.h>

#include <map>
#include <set>
#include <string>
#include <utility>

namespace Crevasse
{
  /** What to say of a mesh that has other cells than quadrilaterals
   * (hexahedra). */
  std::string
  only_hypercubes(const unsigned int dim);

  /** Two nodes by the file's numbers, the smaller first. */
  using EdgeNodes = std::pair<std::size_t, std::size_t>;

  /** The nodes and elements of a Gmsh file, in the order of their numbers. */
  struct GmshMesh
  {
    std::map<std::size_t, dealii::Point<3>> nodes;
    std::vector<MeshElement>                cells;
    std::vector<MeshElement>                boundary;
    std::map<EdgeNodes, std::size_t>        middles; ///< of second order
  };

  /**
   * Reads a .msh file of any format that Gmsh knows, by its library. Not
   * thread-safe.
   *
   * @param cracks the physical groups along which it is cut.
   * @throw SceneError if Gmsh cannot read it, or if it is no mesh of
   * quadrilaterals (hexahedra) whose faces fit together.
   */
  GmshMesh
  read_gmsh_file(const std::string            &file_name,
                 const unsigned int            dim,
                 const std::set<unsigned int> &cracks);
} // namespace Crevasse

#endif
