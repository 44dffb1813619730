// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_averaged_periods_h
#define crevasse_periodic_averaged_periods_h

#include <crevasse/periodic/averaged_body.h>
#include <crevasse/periodic/observed_periods.h>
#include <crevasse/periodic/viscous_coordinates.h>
#include <crevasse/time/evolution.h>

namespace Crevasse
{
  /** Periods of a search with the body averaged over each of them. */
  template <int dim>
  class AveragedPeriods
  {
  public:
    /** All arguments must outlive this object.
     *
     * @param evolution of the periods.
     * @param bounds of the lip. */
    AveragedPeriods(ObservedPeriods<dim>    &periods,
                    Evolution<dim>          &evolution,
                    const Body<dim>         &body,
                    const UnilateralBounds  &bounds,
                    ContactSystemCache<dim> &systems,
                    const unsigned int       n_poles)
      : is_linear(body.law.creep == nullptr)
      , energy(body.space, body.points, body.material.at(0.), 0.)
      , lip(bounds)
      , periods(periods)
      , evolution(evolution)
      , body(body)
      , bounds(bounds)
      , systems(systems)
      , n_poles(is_linear ? n_poles : 1)
    {
      periods.sum_increments();
      evolution.record(&lip);
    }

    AveragedPeriods(const AveragedPeriods &) = delete;

    ~AveragedPeriods()
    {
      evolution.record(nullptr);
    }

    /** Computes a period. @param r viscous strain at its beginning; on return,
     * at its end. @param shows_end see ObservedPeriods::compute(). @return the
     * change of stress. */
    double
    compute(Vector &r, const bool shows_end = false)
    {
      const double change = periods.compute(r, shows_end);
      // A body with the same stages has the same averages.
      const TimeQuadrature rule =
        is_linear ? periods.quadrature() : TimeQuadrature();
      Stages of_period(periods.time_steps(), rule);
      if (averaged && is_linear && of_period.instants == stages.instants)
        return change;
      unsolved_before = n_unsolved();
      averaged.reset();
      stages = std::move(of_period);
      averaged.emplace(
        body, stages, bounds, systems, n_poles, periods.stresses());
      return change;
    }

    /** Body averaged over the last period. */
    AveragedBody<dim> &
    operator*()
    {
      return *averaged;
    }

    /** Number of searches for a LipShift that found none. */
    unsigned int
    n_unsolved() const
    {
      return unsolved_before + (averaged ? averaged->n_unsolved() : 0);
    }

    const bool                    is_linear; ///< whether creep is linear
    const ViscousCoordinates<dim> energy;    ///< norm of elastic energy
    LipHistory                    lip;       ///< of the last period

  private:
    ObservedPeriods<dim>    &periods;
    Evolution<dim>          &evolution;
    const Body<dim>         &body;
    const UnilateralBounds  &bounds;
    ContactSystemCache<dim> &systems;
    const unsigned int       n_poles;

    Stages                           stages; ///< of the last period
    std::optional<AveragedBody<dim>> averaged;
    unsigned int                     unsolved_before = 0;
  };
} // namespace Crevasse

#endif
