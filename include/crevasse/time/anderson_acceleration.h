// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_anderson_acceleration_h
#define crevasse_time_anderson_acceleration_h

#include <crevasse/time/rate_equation.h>

#include <deal.II/lac/qr.h>

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
   *
   * G must not move two points apart in this norm. Then I − G is cocoercive
   * (Baillon and Haddad, Isr. J. Math. 26, 1977): at any point xᵢ with the
   * residual fᵢ the fixed point x* has
   *
   *     fᵢ · (x* − xᵢ) ≥ ½ |fᵢ|².
   *
   * A next point that misses that at some remembered point is known to be
   * wrong: where G has kinks, as where a lip begins to touch, differences from
   * the other side of a kink make such points. Then the oldest differences are
   * left out, one after the other, until the point is possible; without
   * differences it is G(x).
   *
   * A residual that is the same from point to point is a drift, which
   * combinations explain in part at most. It is followed by 1, 2, 4, …
   * residuals at once, as far as that is possible (projective integration: Gear
   * and Kevrekidis, SIAM J. Sci. Comput. 24, 2003), and from where it ends by
   * half of that the next time.
   */
  class AndersonAcceleration
  {
  public:
    /** Residuals are differences of images that are accurate to about this. */
    static constexpr double accuracy = 1e-13;

    struct Settings
    {
      unsigned int depth;   ///< number of differences
      double       damping; ///< β in ]0, 1]; 1: none
      bool         follows_drift = false;
    };

    /** How often something else was done than to combine all differences. */
    struct Counts
    {
      unsigned int shortened = 0; ///< the oldest ones were left out
      unsigned int leaps     = 0; ///< a drift was followed by more than once
    };

    explicit AndersonAcceleration(const Settings &settings)
      : settings(settings)
    {
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

    const Counts &
    counts() const
    {
      return so_far;
    }

    void
    serialize(StateArchive &archive);

  private:
    struct Pair
    {
      Vector image, residual;
      double slowness = 0.; ///< |Δx| / |Δf| to the pair before
    };

    /** @p x from these differences of residuals, factorised, and of images;
     * sets what they leave unexplained. */
    void
    combine(const dealii::QR<Vector>  &factors,
            const std::vector<Vector> &images,
            Vector                    &x);

    /** Whether @p x may be the fixed point for all that is remembered. */
    bool
    is_possible(const Vector &x) const;

    /** Goes along a drift from the last point to @p x if there is one. */
    void
    follow_drift(Vector &x);

    const Settings   settings;
    std::deque<Pair> pairs;              ///< the youngest at the back
    double           unexplained   = 0.; ///< |f − ΔF γ|
    double           residual_norm = 0.; ///< |f|
    double           change        = 0.; ///< of f, relative to it
    double           leap          = 1.; ///< the next one, in residuals
    Counts           so_far;
  };
} // namespace Crevasse

#endif
