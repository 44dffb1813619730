// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/harmonic_balance/fourier_problem.h>
#include <crevasse/model/largest_load.h>
#include <crevasse/periodic/periodic_choice.h>
#include <crevasse/secular/secular_problem.h>

namespace Crevasse
{
  namespace
  {
    using Method = PeriodicMethodType;



    /** Reason why the averaged body is of no use, or empty. */
    template <int dim>
    std::string
    averaged_obstacle(const Scene              &scene,
                      const Body<dim>          &body,
                      const LinearSolverChoice &linear)
    {
      const TimeIntegrationParameters &time = scene.time_integration;
      if (!body.held_by_contact.empty())
        return what_contact_holds(body.held_by_contact) +
               ", whose position may be any of several";
      if (body.law.hardens())
        return "creep that hardens never returns to its state";
      if (traits(time.scheme).has(Trait::is_of_arkode))
        return std::string("Scheme = ") + traits(time.scheme).name +
               " does not provide its stages";
      if (body.effects.contact.on && !traits(linear.type).has(Trait::is_direct))
        return std::string("[Linear solver] Type = ") +
               traits(linear.type).name +
               " does not give the stiffness of the lip, as cholesky and mumps "
               "do";
      if (scene.material.relaxes_in_shear_only())
        return "[Material] Chain in shear only leaves the volume elastic";
      if (!scene.periodic_state.missions.empty() && body.law.creep != nullptr)
        return "Missions are of linear creep";
      return "";
    }



    template <int dim>
    PeriodicChoice
    choose_automatically(const Scene              &scene,
                         const Body<dim>          &body,
                         const StepList           &steps,
                         const LinearSolverChoice &linear,
                         const double              largest_relaxation_time)
    {
      // Relaxation time per period with which stress falls to 1e-4 in a period.
      constexpr double short_time = 0.1;
      const auto      &scheme     = traits(scene.time_integration.scheme);
      const auto choice = [](const Method method, const std::string &why) {
        PeriodicChoice all;
        all.method        = method;
        all.may_fall_back = true;
        all.why           = "automatic: " + why;
        return all;
      };
      if (!body.held_by_contact.empty())
        return choice(Method::march, what_contact_holds(body.held_by_contact));
      if (scene.periodic_state.secular_split == SecularSplitType::off)
        return choice(
          Method::march,
          "Secular split = off leaves the secular flow in the viscous strain");
      if (!scheme.has(Trait::flows_by_mean_load))
        return choice(Method::march,
                      std::string("the steps of Scheme = ") + scheme.name +
                        " do not reproduce the secular flow");
      const std::vector<std::string> obstacles =
        fourier_obstacles(scene, body, steps);
      if (obstacles.empty() &&
          (scheme.value == Scheme::trapezoid ||
           scheme.value == Scheme::automatic) &&
          !scene.time_integration.locate_contact_events)
        return choice(Method::fourier, "only the loads depend on time");
      const std::string flow =
        body.law.has_spring() ? "" : secular_obstacle(body);
      const Method alternative =
        flow.empty() ? Method::anderson : Method::march;
      if (body.law.creep == nullptr &&
          largest_relaxation_time <= short_time * scene.loads.period)
        return choice(alternative, "the stress is forgotten within a period");
      const std::string averaged = averaged_obstacle(scene, body, linear);
      if (!averaged.empty())
        return choice(alternative,
                      "no averaged body, because " + averaged +
                        (flow.empty() ? ""
                                      : "; the viscous strain may not be "
                                        "periodic, because " +
                                          flow));
      // The first obstacle, without the advice that follows it.
      return choice(
        Method::averaged,
        obstacles.empty()
          ? "harmonic balance is for Scheme = trapezoid without located "
            "events"
          : "no harmonic balance, because " +
              obstacles.front().substr(0, obstacles.front().find(';')));
    }



    /** Why friction leaves no method but the march. */
    constexpr const char *friction_remembers =
      "[Boundary] Friction coefficient: where closed lips stick depends on the "
      "way there, so that several states may be periodic";



    template <int dim>
    bool
    has_mean_load(const Body<dim> &body, const StepList &steps)
    {
      constexpr double rounding = 1e-10;
      Vector           mean;
      body.strain_operator.initialize(mean);
      body.loads.mean([](const double) { return 1.; }, steps.period(), mean);
      return mean.linfty_norm() > rounding * largest_load(body, steps);
    }



    template <int dim>
    PeriodicChoice
    choose(const Scene              &scene,
           const Body<dim>          &body,
           const StepList           &steps,
           const LinearSolverChoice &linear,
           const double              largest_relaxation_time)
    {
      const PeriodicStateParameters &parameters = scene.periodic_state;
      if (body.friction)
        {
          if (!parameters.missions.empty())
            throw SceneError("[Periodic state] Missions: must be empty. " +
                             std::string(friction_remembers) + ".");
          if (parameters.method != Method::automatic &&
              parameters.method != Method::march)
            throw SceneError(
              "[Periodic state] Method = " + name_of(parameters.method) +
              ": must be march or automatic. " + friction_remembers + ".");
          PeriodicChoice march;
          march.method = Method::march;
          march.why    = friction_remembers;
          return march;
        }
      if (!parameters.missions.empty())
        if (const std::string obstacle = averaged_obstacle(scene, body, linear);
            !obstacle.empty())
          throw SceneError(
            "[Periodic state] Missions: no averaged body, because " + obstacle +
            ".");
      if (parameters.method == Method::automatic &&
          !parameters.missions.empty())
        {
          PeriodicChoice missions;
          missions.method = Method::averaged;
          missions.why    = "[Periodic state] Missions";
          return missions;
        }
      if (parameters.method == Method::automatic)
        return choose_automatically(
          scene, body, steps, linear, largest_relaxation_time);

      PeriodicChoice choice;
      choice.method = parameters.method;
      choice.why = Text::parameter(PeriodicStateParameters::section, "Method") +
                   " = " + name_of(parameters.method);
      if (choice.method == Method::anderson && !body.held_by_contact.empty())
        throw SceneError(
          choice.why + ": " + what_contact_holds(body.held_by_contact) +
          ", so that its position is not unique. Use Method = march.");
      if (choice.method == Method::averaged)
        if (const std::string obstacle = averaged_obstacle(scene, body, linear);
            !obstacle.empty())
          throw SceneError(choice.why + ": " + obstacle +
                           ". Use Method = automatic.");
      if (choice.method == Method::fourier)
        require_fourier(scene, body, steps);
      if (const std::string flow = secular_obstacle(body);
          choice.method == Method::anderson && !flow.empty() &&
          !body.law.has_spring() && body.law.creep == nullptr)
        throw SceneError(choice.why +
                         ": the viscous strain may not be periodic, because " +
                         flow + ". Use Method = march.");
      if (choice.method == Method::anderson && body.law.hardens())
        throw SceneError(choice.why +
                         ": the creep strain that hardens the body never "
                         "decreases, so that only the stress may be periodic. "
                         "Use Method = march, which checks the stress.");
      if (choice.method == Method::anderson && body.law.creep != nullptr &&
          has_mean_load(body, steps))
        throw SceneError(
          choice.why +
          ": under a mean load the strain of nonlinear creep grows from period "
          "to period, so that only the stress may be periodic. Use Method = "
          "march, which checks the stress.");
      return choice;
    }
  } // namespace



  template <int dim>
  PeriodicChoice
  choose_periodic_method(const Scene              &scene,
                         const Body<dim>          &body,
                         const StepList           &steps,
                         const LinearSolverChoice &linear,
                         const double              largest_relaxation_time)
  {
    if (!body.effects.viscosity.on && !body.friction)
      {
        if (!scene.periodic_state.missions.empty())
          throw SceneError(
            "[Periodic state] Missions: without viscosity all "
            "periods are the same. Leave it empty.");
        PeriodicChoice one_period;
        one_period.why = "without viscosity one period is enough";
        return one_period;
      }
    PeriodicChoice choice =
      choose(scene, body, steps, linear, largest_relaxation_time);
    if (scene.periodic_state.method == Method::march && !body.friction &&
        choose_automatically(
          scene, body, steps, linear, largest_relaxation_time)
            .method != Method::march)
      choice.alternative =
        "set Method = automatic, which mostly needs fewer periods";
    else if (choice.method == Method::anderson &&
             fourier_obstacles(scene, body, steps).empty())
      choice.alternative = "set Method = fourier with Scheme = trapezoid";
    else if (choice.method == Method::anderson &&
             averaged_obstacle(scene, body, linear).empty())
      choice.alternative = "set Method = averaged";
    return choice;
  }



  template decltype(choose_periodic_method<2>) choose_periodic_method<2>;
  template decltype(choose_periodic_method<3>) choose_periodic_method<3>;
} // namespace Crevasse
