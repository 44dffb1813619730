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
   * Names the unconstrained rigid-body motions; if there are none, the
   * stiffness is positive definite. Parts of the mesh that share no face move
   * independently, but a common vertex hinges them. Contact does not count.
   * Collective.
   *
   * @throw SceneError if the mesh has more than 300 parts.
   */
  template <int dim>
  std::vector<std::string>
  find_free_rigid_motions(const Space<dim> &space);

  /**
   * Unconstrained rigid-body motions, each of which opens or closes a lip. Then
   * the stiffness is positive definite on displacements that open nothing, and
   * there is one solution if the loads do negative work on all motions that
   * only open lips (Fichera's condition). Collective.
   *
   * @throw NumericalError with the names of motions along which lips slide, or
   * that move no lip.
   */
  template <int dim>
  std::vector<RigidMotion>
  rigid_motions_held_by_contact(const Space<dim> &space);

  /** Checks that closed nodes hold the body. Collective. @param pressed Flags
   * of LipBasis nodes; other ranks' do not count. @throw NumericalError that
   * names unconstrained motions which move no pressed node. */
  template <int dim>
  void
  require_held(const Space<dim> &space, const std::vector<bool> &pressed);

  /** Reason why many methods fail: "contact alone holds the body against …",
   * with the first of these motions. */
  std::string
  what_contact_holds(const std::vector<RigidMotion> &motions);
} // namespace Crevasse

#endif
