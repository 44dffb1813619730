// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_coulomb_law_h
#define crevasse_contact_coulomb_law_h

#include <deal.II/base/tensor.h>

namespace Crevasse
{
  /** Violation of Coulomb's law: the distance of g_T to the nearest allowed
   * force to g_T − δ. In the plane it is max(|g_T| − μg, min(|δ|, |g_T + μg
   * sign δ|)); in space the direction of a slip that is hardly more than
   * rounding counts no more than the slip itself.
   *
   * @param force g_T along the tangents, relative to a scale of forces.
   * @param limit μg, alike.
   * @param slip δ, relative to a scale of displacements. */
  inline double
  violation_of_friction(const dealii::Tensor<1, 2> &force,
                        const double                limit,
                        const dealii::Tensor<1, 2> &slip)
  {
    dealii::Tensor<1, 2> allowed = force - slip;
    if (const double size = allowed.norm(); size > limit)
      allowed *= limit / size;
    return (force - allowed).norm();
  }
} // namespace Crevasse

#endif
