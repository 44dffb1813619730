// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_grid_coincident_faces_h
#define crevasse_grid_coincident_faces_h

#include <crevasse/grid/gmsh_file.h>

namespace Crevasse
{
  /**
   * Finds faces of the surface, without a role, that coincide with another one:
   * lips of a crack that have separate nodes, or parts that are not connected.
   * Those in no group get a new group, so that a scene can name them.
   *
   * @param with_role Groups with a role.
   * @return A remark for the log; empty if there are none.
   */
  std::string
  find_coincident_faces(const std::set<unsigned int> &with_role,
                        GmshMesh                     &mesh);
} // namespace Crevasse

#endif
