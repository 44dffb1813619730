// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_growth_direction_h
#define crevasse_crack_tip_growth_direction_h

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  /** Direction in which a crack with K_I and K_II grows, by the criterion of
   * the largest hoop stress (Erdogan, Sih, J. Basic Eng. 85, 1963):
   *
   *     tan θ/2 = (K_I − √(K_I² + 8 K_II²)) / (4 K_II),
   *     K       = cos θ/2 (K_I cos² θ/2 − 3/2 K_II sin θ).
   *
   * A closed crack has K_I = 0. */
  struct GrowthDirection
  {
    GrowthDirection(const double K_I, const double K_II)
    {
      const double opening = std::max(K_I, 0.);
      // The formula for tan θ/2, rewritten without cancellation.
      angle               = 0. - 2. * std::atan2(2. * K_II,
                                   opening + std::sqrt(opening * opening +
                                                       8. * K_II * K_II));
      const double cosine = std::cos(0.5 * angle);
      intensity =
        cosine * (opening * cosine * cosine - 1.5 * K_II * std::sin(angle));
    }

    double angle;     ///< angle θ from ahead, counter-clockwise
    double intensity; ///< K of mode I with the same hoop stress
  };

  /** Angle from straight ahead, counter-clockwise, of a short kink with the
   * largest energy release,
   *
   *     G ∝ k₁² + k₂²,      kᵢ = Fᵢ₁ K_I + Fᵢ₂ K_II
   *
   * with expansions of F (Amestoy, Leblond, Int. J. Solids Struct. 29, 1992). A
   * negative K_I or k₁ counts as 0. */
  double
  angle_of_largest_release(const double K_I, const double K_II);
} // namespace Crevasse

#endif
