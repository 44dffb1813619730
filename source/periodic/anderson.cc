// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/periodic/anderson.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Crevasse
{
  namespace
  {
    double
    distance(const Vector &a, const Vector &b)
    {
      Vector difference = a;
      difference -= b;
      return difference.l2_norm();
    }
  } // namespace



  template <int dim>
  Anderson<dim>::Anderson(ObservedPeriods<dim>          &periods,
                          const EnergyCoordinates<dim>  &coordinates,
                          const PeriodicStateParameters &parameters,
                          const double                   slowness,
                          const bool                     may_fall_back)
    : periods(periods)
    , coordinates(coordinates)
    , parameters(parameters)
    , slowness(slowness)
    , may_fall_back(may_fall_back)
    , acceleration({parameters.anderson_depth, parameters.anderson_damping})
  {
  }



  template <int dim>
  ConvergenceStatus
  Anderson<dim>::run(Vector &r)
  {
    const SerializationScope part(periods.checkpointer(),
                                  [this](StateArchive &archive) {
                                    serialize(archive);
                                  });
    Vector                   image, next;
    coordinates.from_strain(r, start);
    for (number = 0; periods.may_go_on(); ++number)
      {
        coordinates.to_strain(start, r);
        const double change = periods.compute(r);
        coordinates.from_strain(r, image);
        // Of steps that are rounding nothing is to be learned.
        constexpr double rounding  = 1e-11;
        const double     smallest  = rounding * image.l2_norm();
        const bool       has_moved = number > 0 && last_step > smallest;
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
            if (last_residual < least_residual)
              {
                least_residual = last_residual;
                best_image     = image;
                since_least    = 0;
              }
            if (!follow_drift(image, next))
              restart_if_stagnant(next);
          }
        last_step = distance(next, start);
        const double error =
          rests ? slowness * change : estimated_error(change);
        periods.report(error);
        if (parameters.tolerance > 0. && error <= parameters.tolerance)
          return ConvergenceStatus::converged;
        if (may_fall_back && stagnations > 0)
          {
            coordinates.to_strain(next, r);
            return ConvergenceStatus::stagnant;
          }
        std::swap(start, next);
      }
    Vector next_strain(r);
    coordinates.to_strain(start, next_strain);
    periods.stop_before(next_strain);
    return ConvergenceStatus::out_of_periods;
  }



  template <int dim>
  void
  Anderson<dim>::serialize(StateArchive &archive)
  {
    archive.section("anderson");
    archive.at_points(start);
    archive.common(number);
    acceleration.serialize(archive);
    archive.at_points(best_image);
    archive.common(least_residual);
    archive.common(since_least);
    archive.common(restarts);
    archive.common(stagnations);
    archive.common(residual_at_restart);
    leaps.serialize(archive);
    archive.common(last_residual);
    archive.common(last_step);
    std::vector<double> changes(changes_per_step.begin(),
                                changes_per_step.end());
    archive.common(changes);
    changes_per_step.assign(changes.begin(), changes.end());
  }



  template <int dim>
  bool
  Anderson<dim>::follow_drift(const Vector &image, Vector &next)
  {
    if (!periods.strain_returns())
      return false;
    const double n_periods = leaps.next(acceleration.unexplained_part(),
                                        acceleration.residual_change(),
                                        last_residual);
    if (n_periods > 0.)
      {
        next = start;
        next.sadd(1. - n_periods, n_periods, image);
        return true;
      }
    if (leaps.has_left())
      {
        acceleration.clear();
        acceleration.add(start, image);
        acceleration.extrapolate(next);
      }
    return false;
  }



  template <int dim>
  void
  Anderson<dim>::restart_if_stagnant(Vector &next)
  {
    // Kinks and noise make residuals rise for a while.
    constexpr double tolerable_rise = 1e3;
    // Leaves most of the periods to what goes on.
    const unsigned int patience =
      std::min(2 * parameters.anderson_depth,
               may_fall_back ? 1 + parameters.maximum_periods / 4
                             : std::numeric_limits<unsigned int>::max());
    if (last_residual > least_residual)
      ++since_least;
    const bool is_in_vain = since_least > patience;
    if (!is_in_vain && last_residual <= tolerable_rise * least_residual)
      return;
    acceleration.clear();
    leaps.clear();
    next = best_image;
    ++restarts;
    // A single step astray does not count as stagnation, nor do several between
    // which residuals fall.
    constexpr double at_least = 0.5;
    if (is_in_vain || least_residual > at_least * residual_at_restart)
      {
        since_least = 0;
        ++stagnations;
      }
    residual_at_restart = least_residual;
  }



  template <int dim>
  double
  Anderson<dim>::estimated_error(const double change) const
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



  template class Anderson<2>;
  template class Anderson<3>;
} // namespace Crevasse
