// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_grid_split_cells_h
#define crevasse_grid_split_cells_h

#include <crevasse/grid/gmsh_file.h>

namespace Crevasse
{
  /**
   * Divides triangles into three quadrilaterals, tetrahedra into four hexahedra
   * and wedges into three, at the middles of edges and the centres of faces and
   * cells. Quadrilaterals and hexahedra are divided only in the directions in
   * which a neighbour is. Boundary elements are divided with their cells, and
   * keep their groups. Curved edges stay on their arcs; other edges of a
   * curved element follow its map of second order.
   *
   * @return A remark for the log; empty if nothing is divided.
   */
  std::string
  split_cells(const unsigned int dim, GmshMesh &mesh);
} // namespace Crevasse

#endif
