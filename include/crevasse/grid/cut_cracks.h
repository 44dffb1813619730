// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_grid_cut_cracks_h
#define crevasse_grid_cut_cracks_h

#include <crevasse/grid/gmsh_file.h>

#include <set>

namespace Crevasse
{
  /**
   * Cuts a mesh along those boundary elements of physical groups that lie
   * between two cells: each becomes one element for either lip. A node is
   * copied for each part into which the cuts divide the cells around it; at a
   * tip there is one part, and both lips share the node. Lips of the file stay.
   *
   * @throw SceneError where no node of an element is doubled.
   */
  void
  cut_cracks(const std::set<unsigned int> &groups, GmshMesh &mesh);
} // namespace Crevasse

#endif
