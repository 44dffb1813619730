// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_grid_mesh_faces_h
#define crevasse_grid_mesh_faces_h

#include <cstddef>
#include <vector>

namespace Crevasse
{
  /** An element of a mesh file, with the file's numbers. */
  struct MeshElement
  {
    std::size_t              number;
    unsigned int             group; ///< physical group; 0 if in none
    std::vector<std::size_t> nodes; ///< its vertices, in Gmsh's order
  };

  /** The nodes of each face of a quadrilateral (hexahedron), once around it. */
  std::vector<std::vector<std::size_t>>
  nodes_of_faces(const MeshElement &cell);

  /**
   * Whether the elements of a mesh file fit together. deal.II takes for granted
   * that at most two cells share a face and see its nodes in the same order. It
   * passes over a boundary element that is no face of a cell, and takes any of
   * two boundary ids.
   *
   * @param cells quadrilaterals (hexahedra)
   * @param boundary lines (quadrilaterals)
   * @throw SceneError that names elements and nodes of the file
   */
  void
  check_faces(const std::vector<MeshElement> &cells,
              const std::vector<MeshElement> &boundary);
} // namespace Crevasse

#endif
