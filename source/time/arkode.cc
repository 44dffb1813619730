// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/state_archive.h>
#include <crevasse/time/arkode.h>
#include <crevasse/time/arkode_failure.h>

#include <arkode/arkode.h>
#include <cmath>
#include <sstream>

namespace Crevasse
{
  namespace
  {
    /** How much larger the largest entry of the rate of stress is than the root
     * mean square of all, for the elastic body over a period; at least 1. */
    double
    peak_of_elastic_rates(RememberedRate &equation,
                          const Vector   &strain_per_stress,
                          const double    period)
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
    if (is_adaptive && parameters.locate_contact_events)
      events = std::make_unique<EventFunctions>(equation);
  }



  void
  Arkode::restart()
  {
    goes_on = false;
  }



  void
  Arkode::start(RateEquation &f, const double t, const Vector &r, Vector &rate)
  {
    equation.attach(f);
    if (!goes_on)
      equation.forget();
    equation.show(t, r, rate);
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
    if (!goes_on)
      begin(f, t, time_step, r);
    else if (driver == nullptr) // of a run that was taken up
      make_driver(f, time_step, r);
    if (is_adaptive)
      take_own_steps(t + time_step, time_step, r);
    else
      take_fixed_step(t, time_step, r);
  }



  void
  Arkode::take_fixed_step(const double t, const double time_step, Vector &r)
  {
    // A step may be tried again with another length.
    if (driver->time() != t)
      driver->restart(t, time_step, r);
    driver->fix_step(time_step, t + time_step);
    driver->step();
    r = driver->state();
  }



  void
  Arkode::begin(const RateEquation &f,
                const double        t,
                const double        time_step,
                const Vector       &r)
  {
    goes_on         = true;
    steps_of_period = 0;
    last_event      = t;
    pending_event   = -1.;
    if (usual_step == 0.)
      {
        usual_step = unit = time_step;
        make_driver(f, time_step, r);
        return;
      }
    if (driver == nullptr) // of a run that was taken up
      make_driver(f, usual_step, r);
    if (events != nullptr)
      driver->seek_events(true);
    if (t == 0.)
      is_first_period = false;
    driver->restart(t, usual_step, r);
  }



  void
  Arkode::make_driver(const RateEquation &f,
                      const double        time_step,
                      const Vector       &r)
  {
    if (is_adaptive && allowed_errors.size() == 0)
      allowed_errors = tolerances(f, r);
    const ArkodeDriver::Settings settings{
      is_implicit, period, unit, is_adaptive, allowed_errors};
    driver = std::make_unique<ArkodeDriver>(
      settings, table, equation, events.get(), time_step, r);
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
  Arkode::take_own_steps(const double end, const double time_step, Vector &r)
  {
    const double rounding = 1e-10 * time_step;
    events_of_interval    = 0;
    if (gave_up)
      driver->seek_events(true);
    gave_up = false;
    while (driver->time() < end - rounding)
      {
        if (++steps_of_period > TimeIntegrationParameters::most_steps)
          throw NumericalError(
            describe_arkode_failure(ARK_TOO_MUCH_WORK, driver->time(), ""));
        if (pending_event >= 0. && driver->time() >= pending_event)
          leave_event();
        if (events != nullptr)
          before_step = driver->state();
        const double t = driver->time();
        if (pending_event < 0.)
          driver->stop_at(next_stop(t));
        if (driver->step())
          meet_event(t, time_step);
        // All periods but the first begin with the same step, so that they
        // differ by what the body remembers alone.
        if (is_first_period && driver->time() < period - rounding)
          usual_step = driver->next_step();
      }
    if (driver->time() > end + rounding)
      driver->interpolate(end, r);
    else
      r = driver->state();
  }



  void
  Arkode::meet_event(const double last_t, const double time_step)
  {
    constexpr double       same = 1e-6; // of the interval between samples
    constexpr unsigned int most = 100;  // in one
    const double           t    = driver->time();
    if (++events_of_interval > most)
      {
        ++events_given_up;
        gave_up = true;
        driver->seek_events(false);
      }
    if (std::abs(t - last_event) <= same * time_step)
      return;
    ++events_located;
    last_event       = t;
    pending_event    = t;
    step_after_event = driver->next_step();
    if (t - last_t <= same * time_step)
      return;
    driver->restart(last_t, t - last_t, before_step);
    driver->stop_at(t);
    driver->seek_events(false);
  }



  void
  Arkode::leave_event()
  {
    pending_event = -1.;
    driver->seek_events(!gave_up);
    driver->restart(driver->time(), step_after_event, Vector(driver->state()));
  }



  bool
  Arkode::may_pause() const
  {
    return !is_adaptive;
  }



  void
  Arkode::serialize(StateArchive &archive)
  {
    archive.section("arkode");
    equation.serialize(archive);
    archive.at_points(allowed_errors);
    archive.common(goes_on);
    archive.common(is_first_period);
    archive.common(usual_step);
    archive.common(unit);
    archive.common(events_located);
    archive.common(events_given_up);
    if (archive.is_loading())
      driver.reset(); // made anew where it is needed
  }



  double
  Arkode::stability_limit() const
  {
    return table.stability_limit();
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
    if (events != nullptr)
      {
        all.emplace_back("contact_events", events_located);
        all.emplace_back("intervals_with_too_many_events", events_given_up);
      }
    return all;
  }
} // namespace Crevasse
