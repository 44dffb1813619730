// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_return_defect_h
#define crevasse_periodic_return_defect_h

#include <crevasse/contact/signorini_problem.h>
#include <crevasse/discretisation/material_field.h>
#include <crevasse/time/secular_flow.h>

namespace Crevasse
{
  /**
   * How far a viscous strain is from being where it was a period before, as an
   * error of the stress: with η ṙ = s,
   *
   *     r(T) − r(0) = T η⁻¹ s̄,
   *
   * so that a stress of which the mean is wrong by δs̄ leaves T η⁻¹ δs̄ (where
   * there is a secular flow: besides T α). In turn δs̄ is K times what is left,
   * at most, times τ/T; which 1/(1−exp(−T/τ)) stands for. Where a lip is
   * pressed for a tenth of the period, which steps resolve, its pressure is
   * wrong by ten times that. Unlike a change of stress it does not vanish where
   * a strain continues to creep without bearing stress until a lip touches.
   */
  template <int dim>
  struct ReturnDefect
  {
    /** The largest component of that stress at all points, relative to
     * that of the stress itself; 0 if it is rounding. Collective. */
    double
    operator()(const Vector &before,
               const Vector &after,
               const double  largest_stress) const;

    /** Whether all of the lip stands open and opens from the one displacement
     * to the next, a period later: a strain that bears no stress brings it no
     * nearer to contact then, and what bears stress shows by its change. Not so
     * with an elastic spring, in which all strain makes stress. Collective. */
    bool
    lip_opens(const Vector &before, const Vector &after) const;

    const std::size_t n_points; ///< of this rank
    /** That makes it a stress; of what varies in time, at one instant. */
    const MaterialState<dim> &material;
    const SecularFlow        *flow;     ///< that goes on besides; null: none
    const bool                is_split; ///< whether that is not in the strain
    /** Mean of 1/η₀ over the period, instead of that of the instant: the strain
     * flows by all of it. */
    const double            mean_fluidity_factor;
    const double            period;
    const UnilateralBounds &bounds; ///< of the lip
  };
} // namespace Crevasse

#endif
