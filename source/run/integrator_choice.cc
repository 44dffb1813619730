// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#include <crevasse/run/integrator_choice.h>
#include <crevasse/run/largest_load.h>
#include <crevasse/time/arkode.h>
#include <crevasse/time/predictor_corrector.h>
#include <crevasse/time/runge_kutta.h>
#include <crevasse/time/sdirk.h>

namespace Crevasse
{
  std::unique_ptr<Integrator>
  make_integrator(const TimeIntegrationParameters &parameters,
                  const double                     period)
  {
    if (parameters.scheme == "euler")
      return std::make_unique<RungeKutta>(euler_tableau());
    if (parameters.scheme == "rk4")
      return std::make_unique<RungeKutta>(rk4_tableau());
    if (parameters.scheme == "predictor corrector")
      return std::make_unique<PredictorCorrector>();
    if (parameters.scheme == "sdirk2")
      return std::make_unique<Sdirk2>();
    if (parameters.scheme == "arkode explicit" ||
        parameters.scheme == "arkode implicit")
      return std::make_unique<Arkode>(parameters, period);
    return std::make_unique<RungeKutta>(heun_tableau(parameters.heun_weight));
  }



  bool
  has_tolerances(const TimeIntegrationParameters &parameters)
  {
    return parameters.step_control == "adaptive";
  }



  template <int dim>
  std::vector<double>
  instants_of_stress_scale(const Body<dim> &body, const StepList &steps)
  {
    constexpr unsigned int n_samples = 8;
    std::vector<double>    instants  = {
          steps.instant(step_of_largest_load(body, steps))};
    for (unsigned int k = 0; k < n_samples; ++k)
      instants.push_back(steps.instant(k * steps.n_steps() / n_samples));
    return instants;
  }



  template std::vector<double>
  instants_of_stress_scale<2>(const Body<2> &, const StepList &);
  template std::vector<double>
  instants_of_stress_scale<3>(const Body<3> &, const StepList &);
} // namespace Crevasse
