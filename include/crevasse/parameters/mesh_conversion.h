// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_mesh_conversion_h
#define crevasse_parameters_mesh_conversion_h

#include <string>
#include <vector>

namespace Crevasse
{
  /** Full path of a file that a scene names, if it is next to the scene file;
   * otherwise the name itself, for the working directory. */
  std::string
  find_file(const std::string &scene_file, const std::string &name);

  /** Gmsh file in results/meshes for a mesh file of another program, with the
   * checksum of the mesh file, and of those that it includes, in its name.
   * Empty for files that need no conversion, or do not exist. */
  std::string
  converted_mesh(const std::string &mesh_file);

  /** Mesh file that a scene reads, before its parameters are parsed; empty if
   * the shape is another one. */
  std::string
  mesh_file_of(const std::string              &scene_file,
               const std::vector<std::string> &overrides);
} // namespace Crevasse

#endif
