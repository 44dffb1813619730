// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_weight_function_h
#define crevasse_crack_tip_weight_function_h

#include <crevasse/contact/signorini_problem.h>

#include <vector>

namespace Crevasse
{
  /**
   * What K_I loads and contact forces cause in an elastic body (Bueckner's
   * weight function, of the discretised body): with the displacement u of A u =
   * F + Lᵀ g, K_I = k·u + l·g, by the interaction integral or by the
   * coefficient of a singular function (l = 0), is
   *
   *     K_I = z·F + Σ (L z + l)_i g_i,       A z = k.
   *
   * One solve serves all instants. A factor of A leaves K_I as it is.
   */
  class WeightFunction
  {
  public:
    /**
     * @param influence z
     * @param bounds those of the contact forces, the nodes of the lip first.
     * @param of_lip l, for the nodes of the lip. */
    WeightFunction(Vector                   &&influence,
                   const UnilateralBounds    &bounds,
                   const std::vector<double> &of_lip);

    /** K_I. Collective. */
    double
    value(const Vector &loads, const std::vector<double> &contact_forces) const;

  private:
    const Vector        influence;
    std::vector<double> of_contact_forces; ///< L z + l
  };
} // namespace Crevasse

#endif
