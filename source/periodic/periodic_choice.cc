// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/harmonic_balance/fourier_problem.h>
#include <crevasse/model/secular_problem.h>
#include <crevasse/periodic/periodic_choice.h>

namespace Crevasse
{
  namespace
  {
    constexpr const char *section = PeriodicStateParameters::section;
    using Method                  = PeriodicMethodType;



    /** What a scene without viscosity needs. */
    PeriodicChoice
    one_period()
    {
      return {Method::march,
              false,
              false,
              "without viscosity one period tells all"};
    }



    template <int dim>
    PeriodicChoice
    choose_automatically(const Scene     &scene,
                         const Body<dim> &body,
                         const StepList  &steps,
                         const double     largest_relaxation_time)
    {
      // Of the period: then stress falls by 1e-4 within it.
      constexpr double  short_time = 0.1;
      const std::string automatic  = "automatic: ";
      const bool        forgets =
        largest_relaxation_time <= short_time * scene.loads.period;
      const std::vector<std::string> obstacles =
        fourier_obstacles(scene, body, steps);
      if (scene.periodic_state.secular_split == SecularSplitType::off)
        return {Method::march,
                false,
                true,
                automatic +
                  "Secular split = off leaves what flows in the "
                  "viscous strain"};
      const auto &scheme = traits(scene.time_integration.scheme);
      if (!scheme.flows_by_mean_load)
        return {Method::march,
                false,
                true,
                automatic + "the steps of Scheme = " + scheme.name +
                  " flow steadily in their own way"};
      if (obstacles.empty() && scheme.value == Scheme::trapezoid &&
          !scene.time_integration.locate_contact_events)
        return {Method::fourier,
                false,
                true,
                automatic + "nothing but the loads depends on time"};
      if (const std::string flow = secular_obstacle(body);
          !flow.empty() && !body.law.has_spring())
        return {Method::march,
                false,
                true,
                automatic +
                  "whether the viscous strain is periodic is not "
                  "known, for " +
                  flow};
      if (forgets)
        return {Method::anderson,
                false,
                true,
                automatic + "the stress is forgotten within a period"};
      if (obstacles.empty())
        return {Method::anderson,
                true,
                true,
                automatic +
                  "nothing but the loads depends on time; the last "
                  "periods bring in what is the scheme's own"};
      // Without what to use instead.
      return {Method::anderson,
              false,
              true,
              automatic + "no direct method, for " +
                obstacles.front().substr(0, obstacles.front().find(';'))};
    }
  } // namespace



  bool
  PeriodicChoice::uses_fourier() const
  {
    return starts_from_fourier || method == Method::fourier;
  }



  bool
  PeriodicChoice::needs_periodic_strain() const
  {
    return method != Method::march;
  }



  bool
  PeriodicChoice::periods_are_iterates() const
  {
    return method == Method::anderson;
  }



  std::string
  PeriodicChoice::describe() const
  {
    return name_of(method) +
           (starts_from_fourier ? ", started from fourier" : "") + " (" + why +
           ')';
  }



  template <int dim>
  PeriodicChoice
  choose_periodic_method(const Scene     &scene,
                         const Body<dim> &body,
                         const StepList  &steps,
                         const double     largest_relaxation_time)
  {
    if (!body.effects.viscosity.on)
      return one_period();
    const PeriodicStateParameters &parameters = scene.periodic_state;
    if (parameters.method == Method::automatic)
      return choose_automatically(scene, body, steps, largest_relaxation_time);

    PeriodicChoice choice;
    choice.method              = parameters.method;
    choice.starts_from_fourier = parameters.method != Method::fourier && //
                                 parameters.start_from == StartFrom::fourier;
    choice.why =
      Text::parameter(section, "Method") + " = " + name_of(parameters.method);
    if (choice.uses_fourier())
      require_fourier(scene, body, steps);
    if (const std::string flow = secular_obstacle(body);
        choice.method == Method::anderson && !flow.empty() &&
        !body.law.has_spring())
      throw SceneError(choice.why +
                       ": whether there is a periodic viscous strain is not "
                       "known, for " +
                       flow + ". Use Method = march.");
    return choice;
  }



  template PeriodicChoice
  choose_periodic_method<2>(const Scene &,
                            const Body<2> &,
                            const StepList &,
                            const double);
  template PeriodicChoice
  choose_periodic_method<3>(const Scene &,
                            const Body<3> &,
                            const StepList &,
                            const double);
} // namespace Crevasse
