// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/state_archive.h>
#include <crevasse/time/arkode.h>

#include <cmath>
#include <sstream>

namespace Crevasse
{
  namespace
  {
    /** How much larger the largest entry of the rate of stress is than the root
     * mean square of all, for the elastic body over a period; at least 1. */
    double
    peak_of_elastic_rates(CachedRate   &equation,
                          const Vector &strain_per_stress,
                          const double  period)
    {
      constexpr unsigned int n_instants = 8;
      Vector                 none, rate;
      none.reinit(strain_per_stress);
      rate.reinit(strain_per_stress, true);
      double largest = 0., mean = 0.;
      for (unsigned int k = 0; k < n_instants; ++k)
        {
          equation.rate(period * k / n_instants, none, rate);
          for (std::size_t i = 0; i < rate.locally_owned_size(); ++i)
            rate.local_element(i) /= strain_per_stress.local_element(i);
          largest += std::pow(rate.linfty_norm(), 2);
          mean += rate.norm_sqr() / rate.size();
        }
      return mean > 0. ? std::sqrt(largest / mean) : 1.;
    }
  } // namespace



  Arkode::Arkode(const TimeIntegrationParameters &parameters,
                 const double                     period)
    : parameters(parameters)
    , period(period)
    , is_implicit(parameters.scheme == Scheme::arkode_implicit)
    , is_adaptive(parameters.step_control == StepControlType::adaptive)
    , table(is_implicit, parameters.order)
  {
  }



  void
  Arkode::start(RateEquation &f, const double t, const Vector &r, Vector &rate)
  {
    equation.attach(f);
    if (!is_continuing)
      equation.forget();
    equation.show(t, r, rate);
  }



  ArkodeDriver::Settings
  Arkode::settings(const RateEquation &f, const Vector &r)
  {
    if (is_adaptive && allowed_errors.size() == 0)
      allowed_errors = tolerances(f, r);
    constexpr double longest = 1. / 4.; // of the period
    return {is_implicit,
            longest * period,
            allowed_errors,
            is_adaptive && parameters.locate_contact_events};
  }



  void
  Arkode::advance(RateEquation &f,
                  const double  t,
                  const double  time_step,
                  const Vector &,
                  Vector &r,
                  Vector *)
  {
    equation.attach(f);
    if (driver == nullptr)
      driver =
        std::make_unique<ArkodeDriver>(settings(f, r), table, equation, t, r);
    else if (!is_continuing || driver->time() != t)
      // A step of a list may be tried again with another length.
      driver->restart(t, r, is_adaptive);
    is_continuing = true;
    if (is_adaptive)
      take_own_steps(t + time_step, time_step);
    else
      driver->fixed_step(time_step);
    r = driver->state();
  }



  Vector
  Arkode::tolerances(const RateEquation &f, const Vector &r)
  {
    const double scale = f.stress_scale();
    double       stress =
      parameters.relative_tolerance * scale + parameters.absolute_tolerance;
    constexpr double rounding = 1e-13;
    if (stress < rounding * scale)
      {
        std::ostringstream message;
        message << "[Time integration] Relative tolerance = "
                << parameters.relative_tolerance
                << " is below what rounding leaves of the stress. Set it, or "
                   "Absolute tolerance, to at least "
                << rounding << " times the largest stress.";
        throw NumericalError(message.str());
      }
    if (stress == 0.) // No load at all: any will do.
      stress = 1.;
    Vector result;
    f.strain_per_stress(r, result);
    result *= table.excess_of_estimate() * stress /
              peak_of_elastic_rates(equation, result, period);
    return result;
  }



  double
  Arkode::next_stop(const double t) const
  {
    const double rounding = 1e-12 * period;
    for (const double stop : parameters.steps)
      if (stop > t + rounding && stop < period)
        return stop;
    return period;
  }



  void
  Arkode::take_own_steps(const double end, const double time_step)
  {
    const double rounding = 1e-10 * time_step;
    while (driver->time() < end - rounding)
      if (driver->evolve(end, next_stop(driver->end_of_step())))
        {
          ++n_events;
          driver->restart(driver->time(), Vector(driver->state()), false);
        }
  }



  void
  Arkode::serialize(StateArchive &archive)
  {
    archive.section("arkode");
    equation.serialize(archive);
    archive.at_points(allowed_errors);
    archive.common(is_continuing);
    archive.common(n_events);
    if (archive.is_loading())
      driver.reset(); // made anew where it is needed
  }



  TimeQuadrature
  Arkode::quadrature() const
  {
    if (is_adaptive)
      return {{0., 0.5, 1.}, {}};
    return table.quadrature();
  }



  std::string
  Arkode::description() const
  {
    return name_of(parameters.scheme) + " with " + table.name() +
           (is_adaptive ? ", adaptive steps" : "");
  }



  IntegratorStatistics
  Arkode::statistics() const
  {
    if (driver == nullptr)
      return {};
    IntegratorStatistics all = driver->statistics();
    all.emplace_back("evaluations", equation.n_evaluations());
    if (is_adaptive && parameters.locate_contact_events)
      all.emplace_back("contact_events", n_events);
    return all;
  }
} // namespace Crevasse
