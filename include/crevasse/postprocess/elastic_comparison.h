// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_elastic_comparison_h
#define crevasse_postprocess_elastic_comparison_h

#include <crevasse/base/log.h>
#include <crevasse/time/observer.h>

#include <vector>

namespace Crevasse
{
  /**
   * Compares the last period with the elastic closed form (model, §2): for a
   * homogeneous body with η = τK and loads F(t) p(x) the periodic stress is
   * F(t) s_el with the elastic solution u_el of a lip that stays open or
   * closed, and the drift per period is T β = T (F̄/τ) u_el.
   *
   * F is measured against the loads at one reference instant.
   */
  class ElasticComparison : public Observer
  {
  public:
    struct Reference
    {
      Vector              displacement; ///< u_el at the reference loads
      Vector              stress;       ///< s_el at the reference loads
      std::vector<double> factor;       ///< F at each step of the period
      /** T F̄/τ, with the integral of F by the rule of the time integrator:
       * what the discrete solution gains is then exactly this times u_el. */
      double drift_factor;
    };

    /** @param drift q(t+T) − q(t) of the last period, which must outlive this
     * object; null without viscosity. */
    ElasticComparison(Reference &&reference, const Vector *drift, Log &log);

    void
    observe(const Sample &sample) override;

    void
    end_of_period(const PeriodReport &) override;

    void
    serialize(StateArchive &archive) override;

    /** summary.json "elastic_comparison". */
    void
    summarise(Summary &summary) override;

  private:
    /** Largest |s − F s_el| over the last period and all points, relative to
     * the largest stress. */
    double
    stress_difference() const
    {
      return last_period;
    }

    /** Largest |q(t+T) − q(t) − T (F̄/τ) u_el|, relative to the largest
     * displacement of T (F̄/τ) u_el or, if that vanishes, of F u_el. */
    double
    drift_difference() const;

    const Reference reference;
    const Vector   *drift;
    Log            &log;

    Vector difference;
    double largest_difference = 0., largest_stress = 0.;
    double last_period = 0.;
  };
} // namespace Crevasse

#endif
