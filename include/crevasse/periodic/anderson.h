// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_anderson_h
#define crevasse_periodic_anderson_h

#include <crevasse/parameters/parameters.h>
#include <crevasse/periodic/anderson_acceleration.h>
#include <crevasse/periodic/drift_leaps.h>
#include <crevasse/periodic/energy_coordinates.h>
#include <crevasse/periodic/observed_periods.h>

#include <deque>
#include <limits>

namespace Crevasse
{
  /**
   * The fixed point of the period map r(0) → r(T) (the paper's Remark 2) by
   * Anderson's acceleration, with the norm of EnergyCoordinates. Each period
   * starts from the combination of what the last ones ended with. Where a mean
   * load makes the body flow, the map must be that of the split form: only then
   * r is periodic.
   *
   * Where the lip stands open, strains that bear no stress are fixed points
   * each, or drift: under a mean load that goes on to close it, by the same
   * residual period after period, which no combination explains. Secants of
   * that are noise. There the drift is followed instead, as by a march, for 1,
   * 2, 4, … periods at once, until something else happens; what was remembered
   * is then of another branch of the map, and is forgotten (DriftLeaps).
   *
   * The error of the stress is estimated before the next period is computed:
   * the step to its start, which the acceleration extrapolates from all that it
   * remembers, and what it cannot explain, or what the residual stands for
   * where the slowest point forgets at its own pace; times the change of stress
   * that the last steps have made. It is not less than what the strain lacks to
   * return (ReturnDefect), for steps may bear hardly any stress; nor than a
   * tenth of what the last step has changed. From a start that is the fixed
   * point but for rounding no step tells anything: then it is the change of
   * stress from period to period, as if it went on at the slowest point's pace.
   */
  template <int dim>
  class Anderson
  {
  public:
    /** @param slowness 1/(1−λ) with the contraction λ of the slowest point by
     * itself: that far from the fixed point residuals may be. 1 if it is not
     * known.
     * @param may_fall_back whether run() gives up where it stagnates. */
    Anderson(ObservedPeriods<dim>          &periods,
             const EnergyCoordinates<dim>  &coordinates,
             const PeriodicStateParameters &parameters,
             const double                   slowness,
             const bool                     may_fall_back);

    /** Starts from the viscous strain @p r at the beginning of a period, which
     * afterwards is that at the end of the last one computed. */
    ConvergenceStatus
    run(Vector &r);

    /** How often the iteration began anew because it stagnated, or
     * because a step went astray. */
    unsigned int
    n_restarts() const
    {
      return restarts;
    }

  private:
    void
    serialize(StateArchive &archive);

    /** Where no combination explains the residual, makes the next start that
     * of a march some periods on, if the strain is known to return. Gives back
     * whether it has. */
    bool
    follow_drift(const Vector &image, Vector &next);

    /** Begins anew from the image of the start with the least residual if
     * residuals have not been less for long, leaps aside, or have risen far. */
    void
    restart_if_stagnant(Vector &next);

    /** Of the stress of the last period, once the step to the next start is
     * known.
     * @param change of the stress in that period. */
    double
    estimated_error(const double change) const;

    ObservedPeriods<dim>          &periods;
    const EnergyCoordinates<dim>  &coordinates;
    const PeriodicStateParameters &parameters;
    const double                   slowness;
    const bool                     may_fall_back;
    AndersonAcceleration           acceleration;

    Vector       start;      ///< of the period, in these coordinates
    unsigned int number = 0; ///< of the period, from 0
    Vector       best_image; ///< of the start with the least residual
    double       least_residual = std::numeric_limits<double>::infinity();
    unsigned int since_least    = 0; ///< periods
    unsigned int restarts       = 0;
    unsigned int stagnations    = 0; ///< restarts before which nothing fell
    /** The least one then. */
    double     residual_at_restart = std::numeric_limits<double>::infinity();
    DriftLeaps leaps;

    double             last_residual = 0.; ///< from a start to its image
    double             last_step     = 0.; ///< from start to start
    std::deque<double> changes_per_step;   ///< of stress, by the last steps
  };
} // namespace Crevasse

#endif
