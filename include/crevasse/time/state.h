// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_state_h
#define crevasse_time_state_h

#include <crevasse/base/state_archive.h>
#include <crevasse/lip/contact_forces.h>

namespace Crevasse
{
  /** The body at one instant. */
  struct State
  {
    /** q; zero in constrained entries, also where displacements are imposed:
     * see Body::nodal_displacement(). */
    Vector        displacement;
    Vector        stress; ///< s at quadrature points
    ContactForces contact_forces;
    FrictionState friction;              ///< empty without friction
    double        stiffness_factor = 1.; ///< k(t)
    double        instant          = 0.; ///< t within the period

    void
    serialize(StateArchive &archive)
    {
      archive.nodal(displacement);
      archive.at_points(stress);
      archive.on_bounds(contact_forces.normal);
      archive.on_bounds(contact_forces.tangential);
      archive.on_bounds(friction.reference);
      archive.common(stiffness_factor);
      archive.common(instant);
    }
  };

  /** The steady part of the motion (model, §2):
   * u = βt + q, ξᵢ = αᵢt + rᵢ. */
  struct SecularFlow
  {
    Vector velocity;    ///< velocity β; zero in constrained entries
    Vector strain_rate; ///< rates αᵢ, in the layout of r
    /** Forces η₀(0) ḡ, with ḡ the mean of g/η₀ over a period. */
    ContactForces contact_forces;
  };
} // namespace Crevasse

#endif
