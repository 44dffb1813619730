// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_rigid_modes_h
#define crevasse_discretisation_rigid_modes_h

#include <crevasse/discretisation/space.h>


namespace Crevasse
{
  /** Translations and infinitesimal rotations as displacement vectors, three in
   * the plane, six in space: rotations about the middle of the body and of unit
   * size. Constraints are left out of account. */
  template <int dim>
  std::vector<Vector>
  rigid_modes(const Space<dim> &space);

  /**
   * Names the unconstrained rigid-body motions; empty if there are
   * none, in which case the stiffness is positive definite. Parts of the mesh
   * that share no face move each on their own, but where they touch in a vertex
   * it hinges them together. Contact does not count: it can hold a body in one
   * direction only. Collective.
   *
   * @throw SceneError if the mesh falls into more than 300 parts.
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
