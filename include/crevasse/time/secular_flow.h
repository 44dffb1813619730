// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_secular_flow_h
#define crevasse_time_secular_flow_h

#include <crevasse/base/vector.h>
#include <crevasse/lip/contact_forces.h>

namespace Crevasse
{
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
