// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#ifndef crevasse_discretisation_rigid_motions_h
#define crevasse_discretisation_rigid_motions_h

#include <crevasse/discretisation/space.h>

#include <string>
#include <vector>

namespace Crevasse
{
  /**
   * Names the rigid motions that the supports leave free, for each connected
   * part of the mesh; empty if there are none, in which case the stiffness is
   * positive definite. Contact does not count: it can hold a body in one
   * direction only.
   */
  template <int dim>
  std::vector<std::string>
  find_free_rigid_motions(const Space<dim> &space);

  /** @throw NumericalError with the names of free rigid motions, if any. */
  template <int dim>
  void
  require_no_rigid_motion(const Space<dim> &space);
} // namespace Crevasse

#endif
