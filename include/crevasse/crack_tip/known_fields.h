// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_known_fields_h
#define crevasse_crack_tip_known_fields_h

#include <crevasse/crack_tip/interaction_integral.h>

namespace Crevasse
{
  /**
   * Fields of known K_I on the mesh of a body: the terms n = 1, 3, 4 of
   * Williams' series, as finite elements interpolate them. Terms have the same
   * stress at the distance TipRegion::largest_radius(), and the first has K_I =
   * 1. The second is uniform stress, which integrals have exactly. Terms
   * that are singular functions of the mesh are left out.
   *
   * What an integral makes of them tells how well the mesh resolves the weight
   * of its square, without any solution.
   */
  class KnownFields
  {
  public:
    /** Interpolates the fields. Collective. */
    KnownFields(const Body<2> &body, const TipRegion &region);

    /** Error of K_I by an integral of isotropic bodies, or of T by one of this
     * mode, in a field of unit K_I: root of the sum of the squares of its
     * errors for these fields. Collective. */
    double
    error_of(const InteractionIntegral &integral,
             const CrackMode            mode = CrackMode::opening) const;

  private:
    /** Stress at the points of the finite-element interpolation of 2μu. */
    Vector
    interpolated_stress(const Body<2>    &body,
                        const TipRegion  &region,
                        const PolarField &field) const;

    ContactForces none;
    /** Stresses, each with its K_I. */
    std::vector<std::pair<Vector, double>> fields;
  };
} // namespace Crevasse

#endif
