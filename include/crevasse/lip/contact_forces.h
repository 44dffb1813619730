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
    /** With friction, forces g_T of each bound along the tangents of its node:
     * a list for each of the dim − 1 tangents; otherwise empty. */
    std::vector<std::vector<double>> tangential;
  };

  /** What friction needs to know at an instant, for each bound of this rank;
   * empty without friction. */
  struct FrictionState
  {
    std::vector<double> coefficients; ///< coefficients of friction μ
    /** Jumps q_T^ref where the increment begins, a list for each tangent. */
    std::vector<std::vector<double>> reference;
  };
} // namespace Crevasse

#endif
