// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_rigid_motions_h
#define crevasse_discretisation_rigid_motions_h

#include <crevasse/discretisation/space.h>

namespace Crevasse
{
  /** A rigid-body motion of parts of the body, and its name. */
  struct RigidMotion
  {
    std::string name;
    Vector      displacement;
  };

  /**
   * Names the unconstrained rigid-body motions; empty if there are
   * none, in which case the stiffness is positive definite. Parts of the mesh
   * that share no face move each on their own, but where they touch in a vertex
   * it hinges them together. Contact does not count. Collective.
   *
   * @throw SceneError if the mesh falls into more than 300 parts.
   */
  template <int dim>
  std::vector<std::string>
  find_free_rigid_motions(const Space<dim> &space);

  /**
   * The unconstrained rigid-body motions, each of which opens or closes a lip.
   * Then the stiffness is positive definite on the displacements that open
   * nothing, and there is one solution if the loads do negative work on all
   * motions that open lips only (Fichera's condition). Collective.
   *
   * @throw NumericalError with the names of motions along which lips slide, or
   * which move none.
   */
  template <int dim>
  std::vector<RigidMotion>
  rigid_motions_held_by_contact(const Space<dim> &space);

  /** @param pressed nodes of LipBasis; those of other ranks do not count.
   * @throw NumericalError with the names of unconstrained motions that open or
   * close none of these. Collective. */
  template <int dim>
  void
  require_held(const Space<dim> &space, const std::vector<bool> &pressed);

  /** "contact alone holds the body against …", the first of these motions; what
   * many methods cannot do with. */
  std::string
  what_contact_holds(const std::vector<RigidMotion> &motions);
} // namespace Crevasse

#endif
