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
   * Anderson acceleration of the fixed-point iteration x ← G(x) (J. ACM 12,
   * 1965; Walker and Ni, SIAM J. Numer. Anal. 49, 2011): with the residuals f =
   * G(x) − x of the last points and the differences ΔF, ΔG of neighbours among
   * them,
   *
   *     γ = argmin |f − ΔF γ|,       x ← G(x) − ΔG γ
   *
   * in the Euclidean norm. Differences that depend on newer ones, within
   * rounding or the accuracy of G, are left out: their coefficients would be
   * noise, and large.
   *
   * G must not move two points apart in this norm. Then I − G is cocoercive
   * (Baillon and Haddad, Isr. J. Math. 26, 1977): at any point xᵢ with the
   * residual fᵢ the fixed point x* has
   *
   *     fᵢ · (x* − xᵢ) ≥ ½ |fᵢ|².
   *
   * A next point that violates this at some remembered point is wrong. Such
   * points result from differences across a kink of G, e.g. where a lip begins
   * to touch. Then the oldest differences are left out, one after the other,
   * until the point is possible; without differences it is G(x).
   */
  class AndersonAcceleration
  {
  public:
    /** Relative accuracy of images G(x), whose differences are residuals. */
    static constexpr double accuracy = 1e-13;

    struct Settings
    {
      unsigned int depth; ///< largest number of differences
      /** Whether G moves no two points apart, so that points can be found to be
       * impossible. */
      bool contracts = true;
    };

    explicit AndersonAcceleration(const Settings &settings)
      : settings(settings)
    {
    }

    /** Stores a point @p x and its image G(x). */
    void
    add(const Vector &x, const Vector &image);

    /** Adds a point of a map that is not known to contract by its image and by
     * the part of G(x) − x that is to vanish: combinations make this residual
     * small. */
    void
    add_measured(const Vector &image, const Vector &residual);

    /** Forgets all points. */
    void
    forget()
    {
      pairs.clear();
    }

    /** Computes the next point @p x. */
    void
    extrapolate(Vector &x);

    /**
     * Estimated distance of the last point from the fixed point besides the
     * step to the next point: the part of its residual that differences do not
     * explain, at the slowest contraction that one of them shows,
     *
     *     |f − ΔF γ| max |x_{k+1} − x_k| / |f_{k+1} − f_k|.
     */
    double
    unexplained_distance() const;

    /** Number of steps without the oldest differences. */
    unsigned int
    n_shortened() const
    {
      return shortened;
    }

    void
    serialize(StateArchive &archive);

  private:
    struct Pair
    {
      Vector image, residual;
      double slowness = 0.; ///< |Δx| / |Δf| to the last pair
    };

    /** Stores a pair instead of the oldest one beyond the depth. */
    void
    keep(Pair &&pair);

    /** Computes @p x from factorised differences of residuals and from
     * differences of images; sets the unexplained residual. */
    void
    combine(const dealii::QR<Vector>  &factors,
            const std::vector<Vector> &images,
            Vector                    &x);

    /** Whether all remembered points admit @p x as the fixed point. */
    bool
    is_possible(const Vector &x) const;

    const Settings   settings;
    std::deque<Pair> pairs;              ///< points, newest last
    double           unexplained   = 0.; ///< norm |f − ΔF γ|
    double           residual_norm = 0.; ///< norm |f|
    unsigned int     shortened     = 0;
  };
} // namespace Crevasse

#endif
