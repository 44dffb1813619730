// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_grid_element_parts_h
#define crevasse_grid_element_parts_h

#include <functional>
#include <vector>

namespace Crevasse
{
  /** Numbers, in their element, of vertices whose mean is a point. */
  using Corners = std::vector<unsigned int>;

  /** Vertices of a line, quadrilateral or hexahedron that is a part of an
   * element, in Gmsh's order. */
  using ElementPart = std::vector<Corners>;

  /**
   * Lines, quadrilaterals or hexahedra into which an element is divided: at the
   * middles of edges, and at the centres of faces and of the element.
   *
   * @param is_divided Whether the edge between two vertices is divided; only
   * called where the element does not require it.
   */
  std::vector<ElementPart>
  parts_of_element(
    const unsigned int                                     element_dim,
    const unsigned int                                     n_vertices,
    const std::function<bool(unsigned int, unsigned int)> &is_divided);
} // namespace Crevasse

#endif
