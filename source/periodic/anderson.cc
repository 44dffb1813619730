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
  Anderson<dim>::Anderson(ObservedPeriods<dim>         &periods,
                          const EnergyCoordinates<dim> &coordinates,
                          const Settings               &settings)
    : periods(periods)
    , coordinates(coordinates)
    , settings(settings)
    , acceleration(settings.acceleration)
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
    forget();
    Vector image, next;
    coordinates.from_strain(r, start);
    for (number = 0; periods.may_go_on(); ++number)
      {
        coordinates.to_strain(start, r);
        const double change = periods.compute(r);
        coordinates.from_strain(r, image);
        // Of steps that are rounding nothing is to be learned.
        constexpr double rounding = 1e-11;
        const double     smallest = rounding * image.l2_norm();
        if (number > 0 && last_step > smallest)
          remember_change(change);

        last_residual = distance(image, start);
        const bool rests =
          number > 0 && last_step <= smallest && last_residual <= smallest;
        next = image;
        if (number >= settings.delay)
          {
            acceleration.add(start, image);
            acceleration.extrapolate(next);
            remember_best(image);
            if (!follow_drift(image, next))
              restart_if_stagnant(next);
          }
        last_step = distance(next, start);
        const double error =
          rests ? settings.slowness * change : estimated_error(change);
        periods.report(error);
        if (settings.tolerance > 0. && error <= settings.tolerance)
          return ConvergenceStatus::converged;
        if (stagnations > settings.most_stagnations)
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
  void
  Anderson<dim>::forget()
  {
    acceleration.clear();
    least_residual      = std::numeric_limits<double>::infinity();
    residual_at_restart = std::numeric_limits<double>::infinity();
    since_least         = 0;
    leaps.clear();
    changes_per_step.clear();
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
  Anderson<dim>::remember_best(const Vector &image)
  {
    if (last_residual >= least_residual)
      return;
    least_residual = last_residual;
    best_image     = image;
    since_least    = 0;
  }



  template <int dim>
  void
  Anderson<dim>::restart_if_stagnant(Vector &next)
  {
    // Kinks and noise make residuals rise for a while.
    constexpr double tolerable_rise = 1e3;
    if (last_residual > least_residual)
      ++since_least;
    const bool is_in_vain = since_least > settings.patience;
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
  void
  Anderson<dim>::remember_change(const double change)
  {
    constexpr unsigned int n_remembered = 3;
    if (!std::isfinite(change)) // adaptive steps are not yet the same
      {
        changes_per_step.clear();
        return;
      }
    changes_per_step.push_back(change / last_step);
    if (changes_per_step.size() > n_remembered)
      changes_per_step.pop_front();
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
               settings.slowness * last_residual);
    return std::max({distance * *std::max_element(changes_per_step.begin(),
                                                  changes_per_step.end()),
                     periods.return_defect(),
                     part_of_change * change});
  }



  template <int dim>
  unsigned int
  Anderson<dim>::n_restarts() const
  {
    return restarts;
  }



  template class Anderson<2>;
  template class Anderson<3>;
} // namespace Crevasse
