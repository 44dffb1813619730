// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_drift_leaps_h
#define crevasse_periodic_drift_leaps_h

#include <crevasse/base/state_archive.h>

namespace Crevasse
{
  /**
   * How many periods at once a search for the fixed point of r(0) → r(T) goes
   * along a drift: a residual that is the same period after period, so that no
   * combination of what was remembered explains it. Strains that bear no stress
   * drift so under a mean load that continues to close an open lip.
   *
   * What is hard to explain alone is none: a search that converges slowly has
   * such residuals too. 1, 2, 4, … as long as it lasts (projective integration:
   * Gear and Kevrekidis, SIAM J. Sci. Comput. 24, 2003). Where a leap has
   * stirred up something else, those that follow once that has died away begin
   * with its length, unless it is quite another drift by its size.
   */
  class DriftLeaps
  {
  public:
    /** Forgets what it knows of the drift. */
    void
    clear()
    {
      *this = DriftLeaps();
    }

    /** How many periods the next step is to go; 0: there is no drift, or it has
     * been followed for too long.
     *
     * @param unexplained_part of the residual of this period, in [0, 1].
     * @param change of the residual since the period before, relative to it.
     * @param residual its norm. */
    double
    next(const double unexplained_part,
         const double change,
         const double residual);

    /** Whether the last leap went to where there is no drift: what was
     * remembered before is of another branch of the map. */
    bool
    has_left() const
    {
      return left;
    }

    void
    serialize(StateArchive &archive)
    {
      archive.common(length);
      archive.common(drift_residual);
      archive.common(leaps);
      archive.common(left);
    }

  private:
    double length         = 1.; ///< of the next leap, in periods
    double drift_residual = 0.;
    bool   leaps          = false; ///< whether the last step was one
    bool   left           = false;
  };
} // namespace Crevasse

#endif
