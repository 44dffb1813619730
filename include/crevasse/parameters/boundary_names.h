// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_boundary_names_h
#define crevasse_parameters_boundary_names_h

#include <crevasse/parameters/scene.h>

namespace Crevasse
{
  /** Replaces the names of physical groups in the lists of boundary ids by
   * their numbers, which stand at the beginning of a Gmsh file. A name that the
   * file has not is reported, with those that it has. */
  void
  replace_boundary_names(Scene &scene, Problems &problems);
} // namespace Crevasse

#endif
