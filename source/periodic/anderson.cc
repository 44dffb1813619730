// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/periodic/anderson.h>


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
        const double error =
          rests ? slowness * change : estimated_error(change);
        periods.report(error);
        if (parameters.tolerance > 0. && error <= parameters.tolerance)
          return ConvergenceStatus::converged;
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
    archive.common(last_residual);
    archive.common(last_step);
    std::vector<double> changes(changes_per_step.begin(),
                                changes_per_step.end());
    archive.common(changes);
    changes_per_step.assign(changes.begin(), changes.end());
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
