// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_grid_cut_cracks_h
#define crevasse_grid_cut_cracks_h

#include <crevasse/grid/gmsh_file.h>

#include <set>

namespace Crevasse
{
  /**
   * Cuts a mesh along the boundary elements of these physical groups that lie
   * between two cells: each becomes one element for either lip. A node is
   * doubled as often as the cells around it fall apart; at a tip they do not,
   * and both lips share it. Lips that the file has already stay as they are.
   *
   * @throw SceneError where no node of an element is doubled.
   */
  void
  cut_cracks(const std::set<unsigned int> &groups, GmshMesh &mesh);
} // namespace Crevasse

#endif
