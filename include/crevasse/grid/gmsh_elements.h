// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_grid_gmsh_elements_h
#define crevasse_grid_gmsh_elements_h

#include <crevasse/grid/gmsh_file.h>

namespace Crevasse
{
  /** Physical groups. */
  using Groups = std::set<unsigned int>;

  /**
   * Reads all elements of a dimension from the file that Gmsh has opened.
   *
   * @param uses Groups by their use in the scene: those with one role, or of
   * one material. Of the groups of an element the one that is used counts.
   * @param mesh Has the nodes, and gets the middles of edges.
   * @throw SceneError if there are elements of other types than lines,
   * triangles, quadrilaterals, tetrahedra, wedges and hexahedra of one order,
   * or if an element has groups of several uses.
   */
  std::vector<MeshElement>
  read_gmsh_elements(const int                  element_dim,
                     const unsigned int         dim,
                     const std::vector<Groups> &uses,
                     GmshMesh                  &mesh);
} // namespace Crevasse

#endif
