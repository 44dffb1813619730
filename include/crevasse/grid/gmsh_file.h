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
  /** Message for a mesh with other cells than quadrilaterals (hexahedra). */
  std::string
  only_hypercubes(const unsigned int dim);

  /** Nodes of an edge by their numbers in the file, the smaller first. */
  using EdgeNodes = std::pair<std::size_t, std::size_t>;

  /** Nodes and elements of a Gmsh file, in the order of their numbers. */
  struct GmshMesh
  {
    std::map<std::size_t, dealii::Point<3>> nodes;
    std::vector<MeshElement>                cells;
    std::vector<MeshElement>                boundary;
    std::map<EdgeNodes, std::size_t>        middles; ///< edge middles
  };

  /**
   * Reads a .msh file of any format with the library of Gmsh. Not thread-safe.
   *
   * @param cracks Physical groups along which the mesh is cut.
   * @throw SceneError if Gmsh cannot read the file, or if the file is not a
   * mesh of quadrilaterals (hexahedra) whose faces fit together.
   */
  GmshMesh
  read_gmsh_file(const std::string            &file_name,
                 const unsigned int            dim,
                 const std::set<unsigned int> &cracks);
} // namespace Crevasse

#endif
