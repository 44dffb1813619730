// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_grid_gmsh_file_h
#define crevasse_grid_gmsh_file_h

#include <crevasse/grid/mesh_faces.h>
#include <crevasse/parameters/boundary_roles.h>

#include <deal.II/base/point.h>

#include <map>
#include <set>
#include <string>
#include <utility>

namespace Crevasse
{
  /** Nodes of an edge by their numbers in the file, the smaller first. */
  using EdgeNodes = std::pair<std::size_t, std::size_t>;

  /** Nodes and elements of a Gmsh file, in the order of their numbers. */
  struct GmshMesh
  {
    std::map<std::size_t, dealii::Point<3>> nodes;
    std::vector<MeshElement>                cells;
    std::vector<MeshElement>                boundary;
    std::map<EdgeNodes, std::size_t>        middles; ///< edge middles
    std::vector<std::string>                remarks; ///< lines for the log
    /** Whether the numbers of entities are those of groups: in format 2 each
     * element has its own group. */
    bool entities_are_groups = false;
  };

  /** Physical groups that a scene names. All others are ignored where an
   * element belongs to several groups, and within the body. */
  struct NamedGroups
  {
    BoundaryRoles          roles;
    std::set<unsigned int> materials;
  };

  /**
   * Reads a .msh file of any format with the library of Gmsh, divides all cells
   * into quadrilaterals (hexahedra), and cuts the mesh along its cracks. Not
   * thread-safe.
   *
   * @throw SceneError if Gmsh cannot read the file, if the faces of its cells
   * do not fit together, or if an element belongs to several groups with
   * different roles or materials.
   */
  GmshMesh
  read_gmsh_file(const std::string &file_name,
                 const unsigned int dim,
                 const NamedGroups &named);
} // namespace Crevasse

#endif
