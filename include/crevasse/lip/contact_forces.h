// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_lip_contact_forces_h
#define crevasse_lip_contact_forces_h

#include <vector>

namespace Crevasse
{
  /** Nodal forces of the lips on each other, on this rank. */
  struct ContactForces
  {
    /** Normal force g of each bound: of the nodes of ContactBoundary in their
     * order, then of other bounds. */
    std::vector<double> normal;
  };
} // namespace Crevasse

#endif
