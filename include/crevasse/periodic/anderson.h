// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_anderson_h
#define crevasse_periodic_anderson_h

#include <crevasse/parameters/parameters.h>
#include <crevasse/periodic/anderson_acceleration.h>
#include <crevasse/periodic/observed_periods.h>
#include <crevasse/periodic/viscous_coordinates.h>


namespace Crevasse
{
  /**
   * The fixed point of the period map r(0) → r(T) (the paper's Remark 2) by
   * Anderson's acceleration, with the norm of ViscousCoordinates. Each period
   * starts from the combination of what the last ones ended with. Where a mean
   * load makes the body flow, the map must be that of the split form: only then
   * r is periodic.
   *
   * Two motions of a body of Maxwell elements, with contact, never move apart
   * in this norm: the acceleration can tell which combinations are wrong, and
   * needs no restart. Where the lip stands open, strains that bear no stress
   * drift under a mean load that closes it. The acceleration follows such
   * drifts if the strain is known to return.
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
     * known. */
    Anderson(ObservedPeriods<dim>          &periods,
             const ViscousCoordinates<dim> &coordinates,
             const PeriodicStateParameters &parameters,
             const double                   slowness);

    /** Starts from the viscous strain @p r at the beginning of a period, which
     * afterwards is that at the end of the last one computed. */
    ConvergenceStatus
    run(Vector &r);

    const AndersonAcceleration::Counts &
    counts() const
    {
      return acceleration.counts();
    }

  private:
    void
    serialize(StateArchive &archive);

    /** Of the stress of the last period, once the step to the next start is
     * known.
     * @param change of the stress in that period. */
    double
    estimated_error(const double change) const;

    ObservedPeriods<dim>          &periods;
    const ViscousCoordinates<dim> &coordinates;
    const PeriodicStateParameters &parameters;
    const double                   slowness;
    AndersonAcceleration           acceleration;

    Vector       start;      ///< of the period, in these coordinates
    unsigned int number = 0; ///< of the period, from 0

    double             last_residual = 0.; ///< from a start to its image
    double             last_step     = 0.; ///< from start to start
    std::deque<double> changes_per_step;   ///< of stress, by the last steps
  };
} // namespace Crevasse

#endif
