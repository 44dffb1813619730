// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/time/adaptive_steps.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Crevasse
{
  namespace
  {
    constexpr unsigned int most_steps = TimeIntegrationParameters::most_steps;



    /** Checks stability. @throw NumericalError if the largest step is not below
     * @p limit × @p smallest_relaxation_time, with advice. */
    void
    require_stability(const StepList &steps,
                      const bool      are_uniform,
                      const double    limit,
                      const double    smallest_relaxation_time)
    {
      const double bound   = limit * smallest_relaxation_time;
      const double largest = steps.largest_step();
      if (largest < bound)
        return;
      std::ostringstream message;
      message << "The time step " << largest
              << " is too large: this scheme is stable below " << limit
              << " times the smallest relaxation time "
              << smallest_relaxation_time << ", that is below " << bound
              << ", whatever the mesh. ";
      const double n_needed =
        std::floor(steps.period() / bound * (1 + 1e-12)) + 1.;
      if (!(n_needed <= most_steps))
        message << "No number of steps is enough: a period has at most "
                << most_steps << " steps, which allow relaxation times above "
                << steps.period() / (limit * most_steps)
                << ". Check the viscosity in [Material], [Loads] Period and "
                   "their units";
      else if (are_uniform)
        message << "Use at least " << static_cast<unsigned int>(n_needed)
                << " steps: --set \"Time integration/Steps per period="
                << static_cast<unsigned int>(n_needed) << '"';
      else
        message << "Add instants to [Time integration] Steps";
      message << "; or choose Scheme = sdirk2, which is stable with any step.";
      throw NumericalError(message.str());
    }



    /** Largest relaxation rate of the stress in the elastic body. */
    double
    elastic_relaxation_rate(const TimeStep &step, const StepList &steps)
    {
      Vector none(step.r), rate(step.r);
      none           = 0.;
      double largest = 0.;
      for (unsigned int k = 0; k < steps.n_steps(); ++k)
        {
          step.f.rate(steps.instant(k), none, rate);
          largest = std::max(largest, step.f.relaxation_rate());
        }
      return largest;
    }
  } // namespace



  double
  StepControl::longest_stable(const TimeStep &step) const
  {
    if (stability_limit == no_stability_limit)
      return no_stability_limit;
    const double rate = step.f.relaxation_rate();
    if (!(stability_limit * most_steps < rate * steps.period()))
      return rate > 0. ? stability_limit / rate : no_stability_limit;
    throw NumericalError(Text::Message()
                         << "The stress relaxes at the rate " << rate
                         << " at t = " << step.t << ", which needs more than "
                         << most_steps << " steps of " << properties.name
                         << " a period. Check [Material] Creep coefficient, "
                            "[Loads] and their units.");
  }



  void
  StepControl::require_stability(const TimeStep &step) const
  {
    if (stability_limit == no_stability_limit)
      return;
    const double length  = step.length,
                 longest = stability_limit / step.f.relaxation_rate();
    if (length <= longest)
      return;
    const double n_needed = std::ceil(
      steps.period() * elastic_relaxation_rate(step, steps) / stability_limit);
    Text::Message message;
    message << "The time step " << length << " from t = " << step.t
            << " on is too large: " << properties.name
            << " is stable with steps of at most " << longest
            << " at the current relaxation rate of the stress. ";
    // Earlier steps that were too long may have caused this stress.
    if (n_needed > most_steps)
      message << "The elastic stress needs more than " << most_steps
              << " steps a period. Check the units of [Material] Creep "
                 "coefficient and of [Loads], or choose ";
    else if (n_needed > steps.n_steps())
      message << "The elastic stress needs at least " << n_needed
              << " [Time integration] Steps per period. Set this number, or "
                 "choose Step control = adaptive or ";
    else
      message << "The stress is larger than the elastic stress, so that no "
                 "sufficient number of steps is known. Choose [Time "
                 "integration] Step control = adaptive or ";
    throw NumericalError(message
                         << "Scheme = sdirk2, which is stable with any step.");
  }



  std::unique_ptr<Integrator>
  control_steps(std::unique_ptr<Integrator>    &&method,
                const TimeIntegrationParameters &parameters,
                StepList                        &steps,
                const double                     smallest_relaxation_time)
  {
    IntegratorProperties properties = method->properties;
    const double         limit      = properties.stability_limit;
    const double         if_checked =
      parameters.check_stability ? limit : no_stability_limit;
    if (parameters.step_control != StepControlType::adaptive)
      {
        if (parameters.check_stability)
          require_stability(steps,
                            parameters.step_control == StepControlType::uniform,
                            limit,
                            smallest_relaxation_time);
        // If the material gives no bound, the stress may.
        if (if_checked == no_stability_limit ||
            std::isfinite(smallest_relaxation_time))
          return std::move(method);
        return std::make_unique<StepControl>(std::move(method),
                                             properties,
                                             steps,
                                             if_checked);
      }
    // Close to the stability limit errors hardly decay.
    const double part    = properties.controls_steps ? 1. : 0.9;
    double       longest = part * if_checked * smallest_relaxation_time;
    if (!properties.controls_steps)
      longest = std::min(longest, steps.period() / parameters.steps_per_period);
    if (steps.period() > most_steps * longest)
      throw NumericalError(
        Text::Message()
        << "The smallest relaxation time allows this scheme steps of "
        << longest << ", which are more than " << most_steps
        << " in a period. Choose Scheme = sdirk2, which is stable with any "
           "step, or check the viscosity in [Material], [Loads] Period and "
           "their units.");
    if (properties.controls_steps)
      return std::move(method); // steps between samples
    properties.repeats_steps = false;
    return make_adaptive_steps(
      std::move(method), properties, parameters, longest, steps, if_checked);
  }
} // namespace Crevasse
