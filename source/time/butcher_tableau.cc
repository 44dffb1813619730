// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/time/butcher_tableau.h>

namespace Crevasse
{
  ButcherTableau
  euler_tableau()
  {
    return {"euler", {0.}, {{}}, {1.}, {}, 2.};
  }



  ButcherTableau
  heun_tableau(const double weight)
  {
    const double c = 1. / (2. * weight);
    return {"heun",
            {0., c},
            {{}, {c}},
            {1. - weight, weight},
            {-weight, weight}, // Euler's method is embedded
            2.};
  }



  ButcherTableau
  rk4_tableau()
  {
    // 1 + z + z²/2 + z³/6 + z⁴/24 = 1 at z = −2.785293563405282.
    return {"rk4",
            {0., 0.5, 0.5, 1.},
            {{}, {0.5}, {0., 0.5}, {0., 0., 1.}},
            {1. / 6., 1. / 3., 1. / 3., 1. / 6.},
            {},
            2.785293563405282};
  }
} // namespace Crevasse
