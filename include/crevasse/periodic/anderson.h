// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_anderson_h
#define crevasse_periodic_anderson_h

#include <crevasse/parameters/parameters.h>
#include <crevasse/periodic/observed_periods.h>
#include <crevasse/periodic/viscous_coordinates.h>
#include <crevasse/time/anderson_acceleration.h>

namespace Crevasse
{
  /**
   * Finds the fixed point of the period map r(0) → r(T) (the paper's Remark 2)
   * by Anderson acceleration, in the norm of ViscousCoordinates. Each period
   * starts from a combination of the final strains of the last periods. If a
   * mean load makes the body flow, the map must be that of the split form: only
   * then is r periodic.
   *
   * The distance of two motions of a Maxwell body with contact never grows in
   * this norm: the acceleration can recognise wrong combinations, and needs no
   * restart.
   *
   * The error of the stress is estimated before the next period is computed:
   * the distance to the fixed point, times the largest change of stress per
   * step of the last periods. The distance is the step to the next start plus
   * what the acceleration cannot explain, or slowness × residual if that is
   * larger. The estimate is at least the ReturnDefect, for steps may bear
   * hardly any stress, and at least a tenth of the last change of stress. If
   * the start is the fixed point except for rounding, the error is slowness ×
   * the change of stress from period to period.
   */
  template <int dim>
  class Anderson
  {
  public:
    /** @param slowness 1/(1−λ) with the contraction λ of the slowest point by
     * itself: the largest ratio of the distance from the fixed point to the
     * residual; 1 if unknown. */
    Anderson(ObservedPeriods<dim>          &periods,
             const ViscousCoordinates<dim> &coordinates,
             const PeriodicStateParameters &parameters,
             const double                   slowness)
      : periods(periods)
      , coordinates(coordinates)
      , slowness(slowness)
      , acceleration({parameters.anderson_depth})
    {
    }

    /** Searches for the periodic state. @param r viscous strain at the
     * beginning of a period; on return, at the end of the last period. */
    void
    run(Vector &r)
    {
      const SerializationScope part(periods.checkpointer(),
                                    [this, &r](StateArchive &archive) {
                                      serialize(archive);
                                      archive.at_points(r);
                                    });
      Vector                   image, next, next_strain(r);
      coordinates.from_strain(r, start);
      for (number = 0;; ++number)
        {
          coordinates.to_strain(start, next_strain);
          if (!periods.begins_another(next_strain))
            return;
          r                   = next_strain;
          const double change = periods.compute(r);
          coordinates.from_strain(r, image);
          // Steps as small as rounding carry no information.
          const double smallest =
            AndersonAcceleration::accuracy * image.l2_norm();
          const bool has_moved = number > 0 && last_step > smallest;
          if (has_moved && std::isfinite(change))
            changes_per_step.push_back(change / last_step);
          else if (has_moved) // adaptive steps do not repeat yet
            changes_per_step.clear();
          constexpr unsigned int n_remembered = 3;
          if (changes_per_step.size() > n_remembered)
            changes_per_step.pop_front();

          last_residual = distance(image, start);
          const bool rests =
            number > 0 && last_step <= smallest && last_residual <= smallest;
          next = image;
          acceleration.add(start, image);
          acceleration.extrapolate(next);
          last_step = distance(next, start);
          periods.report(rests ? slowness * change : estimated_error(change));
          std::swap(start, next);
        }
    }

    /** Number of steps that combined fewer periods than they might. */
    unsigned int
    n_shortened() const
    {
      return acceleration.n_shortened();
    }

  private:
    static double
    distance(const Vector &a, const Vector &b)
    {
      Vector difference = a;
      difference -= b;
      return difference.l2_norm();
    }

    void
    serialize(StateArchive &archive)
    {
      archive.section("anderson");
      archive.at_points(start);
      archive.common(number);
      acceleration.serialize(archive);
      archive.common(last_residual);
      archive.common(last_step);
      std::vector<double> changes(changes_per_step.begin(),
                                  changes_per_step.end());
      archive.common(changes);
      changes_per_step.assign(changes.begin(), changes.end());
    }

    /** Estimated error of the stress of the last period, from the step to the
     * next start. @param change of the stress in the last period. */
    double
    estimated_error(const double change) const
    {
      constexpr double part_of_change = 0.1;
      if (last_step == 0.) // The start is a fixed point.
        return 0.;
      if (changes_per_step.size() < 2)
        return std::numeric_limits<double>::quiet_NaN();
      const double distance =
        std::max(last_step + acceleration.unexplained_distance(),
                 slowness * last_residual);
      return std::max({distance * *std::max_element(changes_per_step.begin(),
                                                    changes_per_step.end()),
                       periods.return_defect(),
                       part_of_change * change});
    }

    ObservedPeriods<dim>          &periods;
    const ViscousCoordinates<dim> &coordinates;
    const double                   slowness;
    AndersonAcceleration           acceleration;

    Vector       start;      ///< the period's start, as coordinates y
    unsigned int number = 0; ///< number of the period, from 0

    double             last_residual = 0.; ///< distance start–image
    double             last_step     = 0.; ///< distance to the next start
    std::deque<double> changes_per_step;   ///< change of stress / step
  };
} // namespace Crevasse

#endif
