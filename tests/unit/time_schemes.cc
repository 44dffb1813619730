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

// Orders of the Runge-Kutta schemes on a nonlinear equation with known
// solution, their stability limits on a decaying one, and the relaxation times
// on which the limits are based.

#include <crevasse/material/maxwell_law.h>
#include <crevasse/material/voigt_matrix.h>
#include <crevasse/scene/problems.h>
#include <crevasse/time/runge_kutta.h>
#include <crevasse/time/step_list.h>

#include <crevasse_tests/tests.h>

using namespace Crevasse;

namespace
{
  /** r' = −r² (1 + cos t): r = 1 / (1 + t + sin t). */
  double
  error(RungeKutta &scheme, const unsigned int n_steps)
  {
    Vector r(1);
    r(0) = 1.;
    for (unsigned int k = 0; k < n_steps; ++k)
      scheme.step(
        [](const double t, const Vector &y, Vector &rate) {
          rate(0) = -y(0) * y(0) * (1. + std::cos(t));
        },
        2. * k / n_steps,
        2. / n_steps,
        r,
        []() {});
    return std::abs(r(0) - 1. / (1. + 2. + std::sin(2.)));
  }

  void
  check_order(const std::string &name, RungeKutta scheme, const double order)
  {
    const double rate = std::log2(error(scheme, 160) / error(scheme, 320));
    check_below(name + ": |order - " + std::to_string(int(order)) + "|",
                std::abs(rate - order),
                0.1);
  }

  double
  decay(RungeKutta &scheme, const double time_step)
  {
    Vector r(1);
    r(0) = 1.;
    for (unsigned int k = 0; k < 1000; ++k)
      scheme.step([](const double,
                     const Vector &y,
                     Vector       &rate) { rate.equ(-1., y); },
                  k * time_step,
                  time_step,
                  r,
                  []() {});
    return std::abs(r(0));
  }

  void
  check_stability(const std::string &name, RungeKutta scheme)
  {
    const double limit = scheme.stability_limit();
    check(name + ": decays below its limit, grows above",
          decay(scheme, 0.99 * limit) < 1. && decay(scheme, 1.01 * limit) > 1.);
  }

  double
  relaxation_rate(const MaterialParameters &material)
  {
    const MaxwellLaw<2> law(material);
    return largest_relaxation_rate<2>(law.branches()[0].fluidity.at(Place<2>()),
                                      law.stiffness().at(Place<2>()));
  }

  void
  check_relaxation_times()
  {
    MaterialParameters material;
    material.young_modulus   = "13000";
    material.poisson_ratio   = "0.2";
    material.relaxation_time = "60";
    for (const char *state : {"plane stress", "plane strain"})
      {
        material.plane_state = state;
        check_below(std::string(state) +
                      ", proportional flow: tau_min / tau - 1",
                    std::abs(relaxation_rate(material) * 60. - 1.),
                    1e-12);
      }

    // Deviatoric flow with its own modulus: shear relaxes with 2 mu / (2
    // mu_eta)
    material.viscosity             = "isotropic";
    material.viscous_modulus       = "3000";
    material.viscous_poisson_ratio = "0.5";
    const double mu = 13000. / 2.4, mu_flow = 3000. / 3.;
    check_below("plane strain, deviatoric flow: tau_min mu / mu_flow - 1",
                std::abs(relaxation_rate(material) * mu_flow / mu - 1.),
                1e-12);
  }

  void
  check_step_list()
  {
    TimeIntegrationParameters parameters;
    parameters.step_control = "list";
    parameters.steps        = {0.1, 0.4};
    const StepList steps(parameters, 1.);
    check("a list is completed by 0 and the period",
          steps.n_steps() == 3 && steps.instant(0) == 0. &&
            steps.instant(3) == 1.);
    check("an instant of the next period falls into this one",
          std::abs(steps.within_period(1.25) - 0.25) < 1e-15 &&
            steps.within_period(1.) == 0. &&
            steps.within_period(1. - 1e-16) == 0.);
    const auto refused = [&](const double tau) {
      try
        {
          steps.require_stability(2., tau);
          return false;
        }
      catch (const NumericalError &)
        {
          return true;
        }
    };
    check("the largest step 0.6 is refused for tau = 0.3, taken for 0.3001",
          refused(0.3) && !refused(0.3001));
  }
} // namespace

int
main(int argc, char **argv)
{
  return run_test(argc, argv, []() {
    check_order("euler", RungeKutta(euler_tableau()), 1.);
    for (const double weight : {0.5, 0.75, 1.})
      check_order("heun with weight " + std::to_string(weight),
                  RungeKutta(heun_tableau(weight)),
                  2.);
    check_order("rk4", RungeKutta(rk4_tableau()), 4.);
    check_stability("euler", RungeKutta(euler_tableau()));
    check_stability("heun", RungeKutta(heun_tableau(0.75)));
    check_stability("rk4", RungeKutta(rk4_tableau()));
    check_relaxation_times();
    check_step_list();
  });
}
