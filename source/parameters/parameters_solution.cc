// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/parameters/checker.h>
#include <crevasse/parameters/parameters.h>

namespace Crevasse
{
  namespace
  {
    /** Over-relaxation converges for these factors only. */
    bool
    is_relaxation_factor(const double value)
    {
      return value > 0. && value < 2.;
    }
  } // namespace



  std::optional<double>
  parse_relaxation_factor(const std::string &text)
  {
    if (text == "automatic")
      return {};
    const auto factor = Text::to_number(text);
    if (!factor || !is_relaxation_factor(*factor))
      throw SceneError(
        "must be \"automatic\" or a number greater than 0 and less than 2");
    return factor;
  }



  void
  DiscretisationParameters::check(Problems &problems) const
  {
    const Checker checker(section, problems);
    checker.demand(degree == 1 || degree == 2,
                   "Degree",
                   degree,
                   "must be 1 or 2");
    checker.demand(volumetric_strain != VolumetricStrain::mean || degree == 1,
                   "Volumetric strain",
                   name_of(volumetric_strain),
                   "is for linear elements only; with Degree = " +
                     std::to_string(degree) + " it must be full");
    checker.demand(singular_functions <= 3,
                   "Singular functions",
                   singular_functions,
                   "must be 0, 1, 2 or 3");
  }



  void
  ContactParameters::check(Problems &problems) const
  {
    const Checker checker(section, problems);

    checker.demand_valid("Relaxation factor", relaxation_factor);
    checker.demand(tolerance > 0. && tolerance <= 1e-2,
                   "Tolerance",
                   tolerance,
                   "must be greater than 0 and at most 0.01");
    checker.demand(maximum_iterations >= 1,
                   "Maximum iterations",
                   maximum_iterations,
                   "must be at least 1");
    for (const double factor : relaxation_table)
      checker.demand(is_relaxation_factor(factor),
                     "Relaxation table",
                     factor,
                     "must be greater than 0 and less than 2");
  }



  void
  LinearSolverParameters::check(Problems &problems) const
  {
    const Checker checker(section, problems);
    checker.demand(tolerance > 0. && tolerance <= 0.1,
                   "Tolerance",
                   tolerance,
                   "must be greater than 0 and at most 0.1");
    checker.demand(memory_for_instants >= 0.,
                   "Memory for instants",
                   memory_for_instants,
                   "must be at least 0");
  }



  void
  TimeIntegrationParameters::check(Problems &problems) const
  {
    const Checker checker(section, problems);
    if (scheme == Scheme::heun)
      checker.demand(heun_weight >= 0.5 && heun_weight <= 1.,
                     "Heun weight",
                     heun_weight,
                     "must be from 0.5, which puts the second stage at the "
                     "end of the step, to 1");
    checker.demand(steps_per_period >= 1 && steps_per_period <= most_steps,
                   "Steps per period",
                   steps_per_period,
                   "must be from 1 to " + std::to_string(most_steps));

    checker.demand(relative_tolerance >= 0. && relative_tolerance < 1.,
                   "Relative tolerance",
                   relative_tolerance,
                   "must be at least 0 and less than 1");
    checker.demand(absolute_tolerance >= 0.,
                   "Absolute tolerance",
                   absolute_tolerance,
                   "must be at least 0");
    if (step_control == StepControlType::adaptive)
      checker.demand(relative_tolerance > 0. || absolute_tolerance > 0.,
                     "Relative tolerance",
                     relative_tolerance,
                     "must be greater than 0, or Absolute tolerance, for the "
                     "step control \"adaptive\"");
    if (step_control == StepControlType::adaptive)
      checker.demand(
        traits(scheme).estimates_error,
        "Scheme",
        name_of(scheme),
        "cannot tell the error of its steps, which the step "
        "control \"adaptive\" needs; heun, exponential, sdirk2 and "
        "those of arkode can");

    if (step_control == StepControlType::uniform)
      return;
    checker.demand(step_control != StepControlType::list || !steps.empty(),
                   "Steps",
                   "",
                   "must be given, for the step control is \"list\"");
    // Of two instants that rounding takes apart a step would be noise.
    constexpr double shortest = 1e-12;
    for (std::size_t i = 0; i < steps.size(); ++i)
      {
        if (i == 0)
          checker.demand(steps[i] == 0. || steps[i] > shortest * steps.back(),
                         "Steps",
                         steps[i],
                         "must be 0, or greater by more than rounding");
        else
          checker.demand(steps[i] - steps[i - 1] > shortest * steps.back(),
                         "Steps",
                         steps[i],
                         "must be later than the instant before it, " +
                           Text::from_number(steps[i - 1]) +
                           ", by more than rounding");
      }
  }



  void
  PeriodicStateParameters::check(Problems &problems) const
  {
    const Checker checker(section, problems);
    checker.demand(tolerance >= 0. && tolerance < 1.,
                   "Tolerance",
                   tolerance,
                   "must be at least 0 and less than 1");
    checker.demand(anderson_damping > 0. && anderson_damping <= 1.,
                   "Anderson damping",
                   anderson_damping,
                   "must be greater than 0 and at most 1");
  }



  void
  OutputParameters::check(Problems &problems) const
  {
    const Checker checker(section, problems);
    for (const double time : field_times)
      checker.demand(time >= 0., "Field times", time, "must be at least 0");
  }
} // namespace Crevasse
