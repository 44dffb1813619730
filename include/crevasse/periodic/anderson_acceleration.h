// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_anderson_acceleration_h
#define crevasse_periodic_anderson_acceleration_h

#include <crevasse/time/rate_equation.h>

#include <deque>

namespace Crevasse
{
  class StateArchive;

  /**
   * Anderson's acceleration of x ← G(x) (J. ACM 12, 1965; Walker and Ni, SIAM
   * J. Numer. Anal. 49, 2011): with the residuals f = G(x) − x of the last
   * points and the differences ΔF, ΔG of neighbours among them,
   *
   *     γ = argmin |f − ΔF γ|,       x ← G(x) − ΔG γ − (1−β)(f − ΔF γ)
   *
   * in the Euclidean norm. Differences that depend on younger ones, to rounding
   * or to what G itself is accurate to, are left out: their coefficients would
   * be noise, and large.
   */
  class AndersonAcceleration
  {
  public:
    struct Settings
    {
      unsigned int depth;   ///< number of differences
      double       damping; ///< β in ]0, 1]; 1: none
    };

    explicit AndersonAcceleration(const Settings &settings)
      : settings(settings)
    {
    }

    /** Forgets all points. */
    void
    clear()
    {
      pairs.clear();
    }

    /** Remembers a point @p x and its image G(x). */
    void
    add(const Vector &x, const Vector &image);

    /** The next point. */
    void
    extrapolate(Vector &x);

    /**
     * How far the last point may be from the fixed point besides the step to
     * the next one: the part of its residual that the differences do not
     * explain, at the slowest contraction that one of them shows,
     *
     *     |f − ΔF γ| max |x_{k+1} − x_k| / |f_{k+1} − f_k|.
     */
    double
    unexplained_distance() const;

    /** |f − ΔF γ| / |f| of the last point; 1 if nothing is remembered. */
    double
    unexplained_part() const
    {
      return residual_norm > 0. ? unexplained / residual_norm : 1.;
    }

    /** |f − f'| / |f| with the residual f' of the point before; infinite if
     * that is not remembered, or if the change is rounding. */
    double
    residual_change() const
    {
      return change;
    }

    void
    serialize(StateArchive &archive);

  private:
    struct Pair
    {
      Vector image, residual;
      double slowness = 0.; ///< |Δx| / |Δf| to the pair before
    };

    const Settings   settings;
    std::deque<Pair> pairs;              ///< the youngest at the back
    double           unexplained   = 0.; ///< |f − ΔF γ|
    double           residual_norm = 0.; ///< |f|
    double           change        = 0.; ///< residual_change()
  };
} // namespace Crevasse

#endif
