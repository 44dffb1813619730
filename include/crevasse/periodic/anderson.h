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
             const double                   slowness)
      : periods(periods)
      , coordinates(coordinates)
      , parameters(parameters)
      , slowness(slowness)
      , acceleration({parameters.anderson_depth,
                      parameters.anderson_damping,
                      periods.strain_returns()})
    {
    }

    /** Starts from the viscous strain @p r at the beginning of a period, which
     * afterwards is that at the end of the last one computed. */
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
          // Of steps that are rounding nothing is to be learned.
          const double smallest =
            AndersonAcceleration::accuracy * image.l2_norm();
          const bool has_moved = number > 0 && last_step > smallest;
          if (has_moved && std::isfinite(change))
            changes_per_step.push_back(change / last_step);
          else if (has_moved) // adaptive steps are not yet the same
            changes_per_step.clear();
          constexpr unsigned int n_remembered = 3;
          if (changes_per_step.size() > n_remembered)
            changes_per_step.pop_front();

          last_residual = distance(image, start);
          const bool rests =
            number > 0 && last_step <= smallest && last_residual <= smallest;
          next = image;
          if (number >= parameters.anderson_delay)
            {
              acceleration.add(start, image);
              acceleration.extrapolate(next);
            }
          last_step = distance(next, start);
          periods.report(rests ? slowness * change : estimated_error(change));
          std::swap(start, next);
        }
    }

    const AndersonAcceleration::Counts &
    counts() const
    {
      return acceleration.counts();
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

    /** Of the stress of the last period, once the step to the next start is
     * known.
     * @param change of the stress in that period. */
    double
    estimated_error(const double change) const
    {
      constexpr double part_of_change = 0.1;
      if (last_step == 0.) // The map gives back what it was given.
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
