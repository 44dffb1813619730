// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/time/adaptive_steps.h>
#include <crevasse/time/arkode.h>
#include <crevasse/time/contact_events.h>
#include <crevasse/time/exponential_heun.h>
#include <crevasse/time/integrator_choice.h>
#include <crevasse/time/predictor_corrector.h>
#include <crevasse/time/runge_kutta.h>
#include <crevasse/time/sdirk.h>
#include <crevasse/time/trapezoid.h>

#include <algorithm>

namespace Crevasse
{
  namespace
  {
    /** Whether the integrator has an adaptive control of its own. */
    bool
    controls_itself(const TimeIntegrationParameters &parameters)
    {
      return traits(parameters.scheme).is_of_arkode &&
             parameters.step_control == StepControlType::adaptive;
    }



    using Parameters = TimeIntegrationParameters;
    using Method     = std::unique_ptr<Integrator>;

    struct Factory
    {
      Scheme value;
      Method (*make)(const Parameters &, const double period);
    };

    template <typename IntegratorType>
    Method
    make(const Parameters &, const double)
    {
      return std::make_unique<IntegratorType>();
    }

    template <ButcherTableau (*tableau)()>
    Method
    make(const Parameters &, const double)
    {
      return std::make_unique<RungeKutta>(tableau());
    }

    Method
    make_heun(const Parameters &parameters, const double)
    {
      return std::make_unique<RungeKutta>(heun_tableau(parameters.heun_weight));
    }

    Method
    make_arkode(const Parameters &parameters, const double period)
    {
      return std::make_unique<Arkode>(parameters, period);
    }

    constexpr Factory factories[] = {
      {Scheme::euler, make<euler_tableau>},
      {Scheme::heun, make_heun},
      {Scheme::rk4, make<rk4_tableau>},
      {Scheme::predictor_corrector, make<PredictorCorrector>},
      {Scheme::exponential, make<ExponentialHeun>},
      {Scheme::sdirk2, make<Sdirk2>},
      {Scheme::trapezoid, make<Trapezoid>},
      {Scheme::arkode_explicit, make_arkode},
      {Scheme::arkode_implicit, make_arkode}};

    static_assert(follows_enum<Scheme>(factories),
                  "one for each scheme, in their order");
  } // namespace



  std::unique_ptr<Integrator>
  make_integrator(TimeIntegrationParameters parameters,
                  const double              period,
                  const bool                has_contact)
  {
    parameters.locate_contact_events &= has_contact;
    std::unique_ptr<Integrator> method =
      factories[static_cast<std::size_t>(parameters.scheme)].make(parameters,
                                                                  period);
    if (parameters.locate_contact_events && !controls_itself(parameters))
      return std::make_unique<ContactEvents>(std::move(method));
    return method;
  }



  std::unique_ptr<StepControl>
  make_step_control(const TimeIntegrationParameters &parameters,
                    const StepList                  &steps,
                    const Integrator                &integrator,
                    const double                     smallest_relaxation_time)
  {
    const double limit = integrator.stability_limit();
    if (parameters.step_control != StepControlType::adaptive)
      {
        if (parameters.check_stability)
          steps.require_stability(limit, smallest_relaxation_time);
        return std::make_unique<FixedSteps>();
      }
    if (controls_itself(parameters))
      {
        if (parameters.check_stability)
          steps.require_possible(limit * smallest_relaxation_time);
        return std::make_unique<FixedSteps>(); // from sample to sample
      }
    // Close to the limit errors hardly decay.
    constexpr double well_below = 0.9;
    double largest_step         = steps.period() / parameters.steps_per_period;
    if (parameters.check_stability)
      largest_step =
        std::min(largest_step, well_below * limit * smallest_relaxation_time);
    steps.require_possible(largest_step);
    const std::vector<double> nodes = integrator.quadrature().nodes;
    return std::make_unique<AdaptiveSteps>(
      AdaptiveSteps::Settings{parameters.relative_tolerance,
                              parameters.absolute_tolerance,
                              largest_step,
                              steps.fixed_instants(),
                              std::find(nodes.begin(), nodes.end(), 1.) !=
                                nodes.end()});
  }
} // namespace Crevasse
