// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/state_archive.h>
#include <crevasse/time/adaptive_steps.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace Crevasse
{
  namespace
  {
    constexpr unsigned int most_searches = 3;
    // Steps are found anew if so many of them would do.
    constexpr double too_many = 0.5;
    constexpr double safety   = 0.9;
    // The error of the embedded method of order 1 is larger than that of the
    // method that goes on, of order 2, which falls in proportion to it. With
    // this part of it the error of a period comes close to the tolerance
    // (tests/runs/test_adaptive.py), and stays below.
    constexpr double part_of_estimate = 0.125;



    [[noreturn]] void
    fail(const double t, const double step, const double error)
    {
      std::ostringstream message;
      message << "the tolerance takes more than "
              << TimeIntegrationParameters::most_steps
              << " steps a period: from t = " << t << " on a step of " << step
              << " still has " << error
              << " times the error that is allowed. Choose a larger [Time "
                 "integration] Relative tolerance; if a load or a material "
                 "jumps at an instant, name it in Steps, so that a step ends "
                 "there.";
      throw NumericalError(message.str());
    }
  } // namespace



  AdaptiveSteps::AdaptiveSteps(const Settings &settings)
    : settings(settings)
    // Not a fraction of the period, at which a load may have its zeros.
    , proposed(0.381966 * settings.largest_step)
  {
  }



  void
  AdaptiveSteps::begin_period(StepList &steps)
  {
    is_free =
      n_found == 0 || (n_found < most_searches && needed < too_many * taken);
    if (is_free)
      {
        steps.reset(settings.fixed_instants);
        ++n_found;
      }
    needed = 0.;
    taken  = 0;
  }



  double
  AdaptiveSteps::dyadic_step(const double t, const double longest) const
  {
    const std::vector<double> &fixed = settings.fixed_instants;
    const double rounding            = 1e-12 * (fixed.back() - fixed.front());
    const auto   after =
      std::upper_bound(fixed.begin(), fixed.end() - 1, t + rounding);
    const double begin = *(after - 1);
    double       step  = *after - begin;
    const auto   fits  = [&]() {
      const double parts = (t - begin) / step;
      return step <= longest * (1. + 1e-12) &&
             std::abs(parts - std::round(parts)) * step <= rounding;
    };
    while (!fits())
      step *= 0.5;
    return step;
  }



  double
  AdaptiveSteps::first_trial(const Integrator &integrator,
                             const double      t,
                             const double      end) const
  {
    const double left = end - t;
    if (!is_free)
      return left;
    const double longest = std::min(proposed, settings.largest_step);
    if (integrator.has_matrix_of_step())
      return std::min(left, dyadic_step(t, longest));
    // Two steps of the same length instead of one and a short rest.
    return left <= longest ? left : std::min(longest, 0.5 * left);
  }



  double
  AdaptiveSteps::relative_error(const RateEquation &f, const Vector &r)
  {
    if (!scale.partitioners_are_compatible(*r.get_partitioner()) ||
        scale.size() == 0)
      f.strain_per_stress(r, scale);
    double largest = 0.;
    for (unsigned int i = 0; i < error.locally_owned_size(); ++i)
      {
        const double stress =
          std::abs(error.local_element(i)) / scale.local_element(i);
        largest = std::max(largest,
                           std::isfinite(stress)
                             ? stress
                             : std::numeric_limits<double>::infinity());
      }
    largest = dealii::Utilities::MPI::max(largest, r.get_mpi_communicator());
    const double allowed = settings.relative_tolerance * f.stress_scale() +
                           settings.absolute_tolerance;
    return largest == 0. ? 0. : part_of_estimate * largest / allowed;
  }



  double
  AdaptiveSteps::relative_error_of_end(Integrator   &integrator,
                                       RateEquation &f,
                                       const double  t,
                                       const double  step,
                                       const Vector &rate,
                                       const Vector &r)
  {
    if (settings.looks_at_end)
      return 0.;
    end_rate.reinit(r, true);
    integrator.start(f, t + step, r, end_rate);
    known_end = t + step;
    error     = r;
    error -= saved;
    error.add(-0.5 * step, rate, -0.5 * step, end_rate);
    return relative_error(f, r);
  }



  void
  AdaptiveSteps::start(Integrator        &integrator,
                       RateEquation      &f,
                       const StepList    &steps,
                       const unsigned int k,
                       const Vector      &r,
                       Vector            &rate)
  {
    const double t = steps.instant(k);
    if (k > 0 && std::abs(known_end - t) <= 1e-12 * steps.period() &&
        !steps.jumps_at(t))
      rate = end_rate;
    else
      integrator.start(f, t, r, rate);
    known_end = -1.;
  }



  void
  AdaptiveSteps::propose(const double step,
                         const double step_error,
                         const bool   was_rejected)
  {
    // The error of the embedded method is of the order 2 in the step.
    const double now    = std::max(step_error, 1e-8);
    double       factor = safety * std::pow(now, -0.35) * //
                    std::pow(last_error, 0.2);
    factor     = std::clamp(factor, 0.2, was_rejected ? 1. : 4.);
    proposed   = std::min(step * factor, settings.largest_step);
    last_error = now;
  }



  void
  AdaptiveSteps::advance(Integrator        &integrator,
                         RateEquation      &f,
                         StepList          &steps,
                         const unsigned int k,
                         const Vector      &rate,
                         Vector            &r)
  {
    const double t = steps.instant(k), end = steps.instant(k + 1);
    double       step         = first_trial(integrator, t, end);
    bool         was_rejected = false;
    error.reinit(r, true);
    saved = r;
    while (true)
      {
        error = 0.;
        integrator.advance(f, t, step, rate, r, &error);
        double step_error = relative_error(f, r);
        if (step_error <= 1.)
          step_error =
            std::max(step_error,
                     relative_error_of_end(integrator, f, t, step, rate, r));
        if (step_error <= 1.)
          {
            propose(step, step_error, was_rejected);
            needed += std::max(std::sqrt(step_error) / safety,
                               step / settings.largest_step);
            break;
          }
        if (step * TimeIntegrationParameters::most_steps < steps.period())
          fail(t, step, step_error);
        ++rejected;
        was_rejected = true;
        r            = saved;
        if (known_end >= 0.)
          {
            // The method has started from the end already.
            integrator.restart();
            integrator.start(f, t, r, end_rate);
            known_end = -1.;
          }
        // The steps of a list are halved, so that its lengths stay few.
        const bool   halves = !is_free || integrator.has_matrix_of_step();
        const double factor =
          std::isfinite(step_error) ? safety / std::sqrt(step_error) : 0.1;
        step *= halves ? 0.5 : std::clamp(factor, 0.1, 0.8);
      }
    ++accepted;
    ++taken;
    if (end - t - step > 1e-12 * steps.period())
      steps.divide(k, t + step);
  }



  IntegratorStatistics
  AdaptiveSteps::statistics() const
  {
    return {{"accepted_steps", accepted},
            {"rejected_steps", rejected},
            {"steps_of_last_period", taken},
            {"searches_for_steps", n_found}};
  }



  void
  AdaptiveSteps::serialize(StateArchive &archive)
  {
    archive.section("adaptive steps");
    archive.common(is_free);
    archive.common(n_found);
    archive.common(proposed);
    archive.common(last_error);
    archive.common(needed);
    archive.common(taken);
    archive.common(accepted);
    archive.common(rejected);
    archive.common(known_end);
    archive.at_points(end_rate);
  }
} // namespace Crevasse
