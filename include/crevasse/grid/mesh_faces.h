// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_grid_mesh_faces_h
#define crevasse_grid_mesh_faces_h

#include <cstddef>
#include <set>
#include <vector>

namespace Crevasse
{
  /** Element of a mesh file, with the numbers of the file. */
  struct MeshElement
  {
    std::size_t              number;
    unsigned int             group; ///< physical group, or 0
    std::vector<std::size_t> nodes; ///< vertices, in Gmsh's order
  };

  /** Nodes of each face of a quadrilateral (hexahedron), in cyclic order. */
  std::vector<std::vector<std::size_t>>
  nodes_of_faces(const MeshElement &cell);

  /** Nodes by their numbers: what tells a face, whatever its order is. */
  std::vector<std::size_t>
  sorted_nodes(std::vector<std::size_t> nodes);

  /**
   * Checks that the elements of a mesh file fit together. deal.II assumes that
   * at most two cells share a face and see its nodes in the same order, and
   * ignores a boundary element that is no face of a cell.
   *
   * @param cells Quadrilaterals (hexahedra).
   * @param boundary Lines (quadrilaterals). Those of groups without a role that
   * are not on the surface of the body are removed.
   * @param groups Groups with a role.
   * @throw SceneError that names elements and nodes of the file.
   */
  void
  check_faces(const std::vector<MeshElement> &cells,
              const std::set<unsigned int>   &groups,
              std::vector<MeshElement>       &boundary);
} // namespace Crevasse

#endif
