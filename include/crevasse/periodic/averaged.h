// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_averaged_h
#define crevasse_periodic_averaged_h

#include <crevasse/periodic/averaged_body.h>
#include <crevasse/periodic/observed_periods.h>
#include <crevasse/periodic/viscous_coordinates.h>
#include <crevasse/time/anderson_acceleration.h>
#include <crevasse/time/evolution.h>

namespace Crevasse
{
  /**
   * Finds the periodic stress by steps of the AveragedBody, however far the
   * relaxation times of its points lie apart, with Anderson acceleration of
   * these steps. The acceleration minimises the stress that a step would cause,
   * in the norm of the elastic energy: strain without stress may flow on.
   *
   * If creep is not linear, the body is averaged anew after each period, with
   * one pole. The steps are then nearly those of Newton's method, to which
   * differences of several periods are little help.
   *
   * The estimated error of a period's stress is the largest stress that the
   * step from its beginning would cause, and at least a hundredth of the change
   * from the period before: a step that changes contact much may promise a
   * better period than the next one is.
   */
  template <int dim>
  class Averaged
  {
  public:
    /** All arguments must outlive this object.
     *
     * @param evolution of the periods.
     * @param bounds of the lip. */
    Averaged(ObservedPeriods<dim>          &periods,
             Evolution<dim>                &evolution,
             const Body<dim>               &body,
             const UnilateralBounds        &bounds,
             ContactSystemCache<dim>       &systems,
             const PeriodicStateParameters &parameters)
      : periods(periods)
      , evolution(evolution)
      , body(body)
      , bounds(bounds)
      , systems(systems)
      , is_linear(body.law.creep == nullptr)
      , n_poles(is_linear ? parameters.averaged_poles : 1)
      , lip(bounds)
      , energy(body.space, body.points, body.material.at(0.), 0.)
      , acceleration({is_linear ? parameters.anderson_depth
                                : std::min(parameters.anderson_depth, 2u),
                      false,
                      false})
    {
      periods.sum_increments();
      evolution.record(&lip);
    }

    ~Averaged()
    {
      evolution.record(nullptr);
    }

    /** Searches for the periodic state. @param r viscous strain at the
     * beginning of a period; on return, at the end of the last period. */
    void
    run(Vector &r)
    {
      Vector                   start = r, step, residual, image, change;
      const SerializationScope part(periods.checkpointer(),
                                    [&](StateArchive &archive) {
                                      archive.section("averaged");
                                      archive.at_points(start);
                                      archive.at_points(r);
                                      archive.common(least_residual);
                                      acceleration.serialize(archive);
                                      lip.serialize(archive);
                                    });
      for (;;)
        {
          step = start;
          if (!periods.begins_another(step))
            return;
          r                                 = step;
          const double     change_of_stress = periods.compute(r);
          constexpr double part_of_change   = 0.01;
          average();
          averaged->find_step(periods.increment(), lip, step, residual);
          const double stress = averaged->largest_stress(residual);
          start += step;
          energy.from_strain(start, image);
          energy.from_strain(residual, change);
          accelerate(image, change);
          energy.to_strain(image, start);
          // std::max() returns its first argument if the change is nan.
          periods.report(
            std::max(stress > 0. ? stress / periods.largest_stress() : 0.,
                     part_of_change * change_of_stress));
        }
    }

    /** Number of periods whose LipShift was not found. */
    unsigned int
    n_unsolved() const
    {
      return unsolved_before + (averaged ? averaged->n_unsolved() : 0);
    }

  private:
    /** Averages the body over the last period, unless that was like the one
     * before. */
    void
    average()
    {
      const TimeQuadrature rule =
        is_linear ? periods.quadrature() : TimeQuadrature();
      Stages of_period(periods.time_steps(), rule);
      if (averaged && is_linear && of_period.instants == stages.instants)
        return;
      unsolved_before = n_unsolved();
      averaged.reset();
      stages = std::move(of_period);
      averaged.emplace(
        body, stages, bounds, systems, n_poles, periods.stresses());
    }

    /** Computes the next start. @param[in,out] image end of the step; then the
     * start. */
    void
    accelerate(Vector &image, const Vector &residual)
    {
      // Contact that switches and creep that is not linear can make
      // differences worthless.
      const double worse = is_linear ? 3. : 1.;
      const double size  = residual.l2_norm();
      if (size > worse * least_residual)
        {
          acceleration.forget();
          least_residual = size;
        }
      least_residual = std::min(least_residual, size);
      acceleration.add_measured(image, residual);
      acceleration.extrapolate(image);
    }

    ObservedPeriods<dim>    &periods;
    Evolution<dim>          &evolution;
    const Body<dim>         &body;
    const UnilateralBounds  &bounds;
    ContactSystemCache<dim> &systems;
    const bool               is_linear; ///< whether creep is linear
    const unsigned int       n_poles;

    Stages                           stages; ///< of the last period
    LipHistory                       lip;
    std::optional<AveragedBody<dim>> averaged;
    unsigned int                     unsolved_before = 0;

    const ViscousCoordinates<dim> energy;
    AndersonAcceleration          acceleration;
    double least_residual = std::numeric_limits<double>::max();
  };
} // namespace Crevasse

#endif
