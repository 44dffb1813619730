// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_averaged_h
#define crevasse_periodic_averaged_h

#include <crevasse/periodic/averaged_periods.h>
#include <crevasse/time/anderson_acceleration.h>

namespace Crevasse
{
  /**
   * Finds the periodic stress by steps of the AveragedBody, however far the
   * relaxation times of its points lie apart, with Anderson acceleration of
   * these steps. The acceleration minimises the stress that a step would cause,
   * in the norm of the elastic energy: strain without stress may flow on.
   *
   * If creep is not linear, the body is averaged anew after each period, with
   * one pole. The steps are then nearly those of Newton's method, to which the
   * difference of two periods is some help, and differences of more are none.
   *
   * The estimated error of a period's stress is the largest stress that the
   * step from its beginning would cause, and at least a hundredth of the change
   * from the period before: a step that changes contact much may promise a
   * better period than the next one is. It is at least the change itself where
   * that shrinks less than the steps of an averaged body make it: these then
   * miss something.
   */
  template <int dim>
  class Averaged
  {
  public:
    /** All arguments must outlive this object. */
    Averaged(ObservedPeriods<dim> &periods,
             AveragedPeriods<dim> &averaged,
             const unsigned int    anderson_depth)
      : periods(periods)
      , averaged(averaged)
      , acceleration(
          {averaged.is_linear ? anderson_depth : std::min(anderson_depth, 1u),
           false})
    {
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
                                      archive.common(last_change);
                                      acceleration.serialize(archive);
                                      averaged.lip.serialize(archive);
                                    });
      for (;;)
        {
          step = start;
          if (!periods.begins_another(step))
            return;
          r                                 = step;
          const double     change_of_stress = averaged.compute(r);
          constexpr double small_part = 0.01, slowest = 0.4;
          const double     part_of_change =
            change_of_stress > slowest * last_change ? 1. : small_part;
          last_change = change_of_stress;
          (*averaged).find_step(periods.increment(),
                                averaged.lip,
                                step,
                                residual);
          const double stress = (*averaged).largest_stress(residual);
          start += step;
          averaged.energy.from_strain(start, image);
          averaged.energy.from_strain(residual, change);
          accelerate(image, change);
          averaged.energy.to_strain(image, start);
          // std::max() returns its first argument if the change is nan.
          periods.report(
            std::max(stress > 0. ? stress / periods.largest_stress() : 0.,
                     part_of_change * change_of_stress));
        }
    }

  private:
    /** Computes the next start. @param[in,out] image end of the step; then the
     * start. */
    void
    accelerate(Vector &image, const Vector &residual)
    {
      // Contact that switches and creep that is not linear can make
      // differences worthless.
      const double worse = averaged.is_linear ? 3. : 1.;
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

    ObservedPeriods<dim> &periods;
    AveragedPeriods<dim> &averaged;
    AndersonAcceleration  acceleration;
    double                least_residual = std::numeric_limits<double>::max();
    double                last_change    = std::numeric_limits<double>::max();
  };
} // namespace Crevasse

#endif
