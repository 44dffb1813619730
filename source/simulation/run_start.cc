// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/linear/mumps_instance.h>
#include <crevasse/simulation/run.h>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  void
  Run<dim>::find_secular_flow()
  {
    const Stopwatch phase("secular problem");
    try
      {
        flow = solve_secular_problem(body, split.mean_load, systems);
      }
    catch (const NumericalError &error)
      {
        end_abandoned_factors();
        const std::string what =
          std::string(
            "the stationary contact problem for beta, with viscosity instead "
            "of stiffness, was not solved: ") +
          error.what();
        if (scene.periodic_state.secular_split == SecularSplitType::on)
          throw NumericalError("[Periodic state] Secular split = on: " + what);
        if (split.is_split && !choice.may_fall_back)
          throw NumericalError(
            what +
            " Use [Periodic state] Method = march, which does not need it.");
        if (split.is_split)
          {
            choice               = PeriodicChoice();
            choice.may_fall_back = true;
            choice.why           = "automatic: the flow was not found";
          }
        // The rest of the run does not need the flow.
        split.is_split = split.strain_returns = split.effect.on = false;
        split.effect.why                                        = what;
        log.line("  warning: " + what);
      }
  }



  template <int dim>
  void
  Run<dim>::take_flow_of_samples()
  {
    const bool flows = direct->flow.has_value();
    flow             = direct->flow;
    split.is_split   = flows;
    if (flows && !split.effect.on)
      {
        split.effect.why =
          "the mean load vanishes, but the mean of its samples does not";
        later_warnings.emplace_back(
          "[Time integration] Steps per period: the mean load vanishes, but "
          "the mean of its samples does not: the secular flow is an error of "
          "the steps");
        log.line("  warning: " + later_warnings.back());
      }
    split.effect.on = flows;
  }



  template <int dim>
  void
  Run<dim>::balance_harmonics()
  {
    const Stopwatch phase("harmonic balance");
    try
      {
        FourierResult result = solve_fourier_problem(
          scene, body, steps, systems, magnitudes.relaxation_times.smallest);
        log.line(result.describe());
        for (const std::string &warning : result.warnings)
          log.line("  warning: " + warning);
        later_warnings = result.warnings;
        if (choice.method != PeriodicMethodType::fourier)
          {
            // Another method needs only the beginning of the motion.
            result.motion.viscous_strain.resize(1);
            result.motion.displacement.clear();
            result.motion.contact_forces.clear();
          }
        direct = std::move(result);
      }
    catch (const NumericalError &error)
      {
        if (!choice.may_fall_back)
          throw;
        end_abandoned_factors();
        log.line("  warning: harmonic balance failed, anderson takes over: " +
                 std::string(error.what()));
        choice.method              = PeriodicMethodType::anderson;
        choice.starts_from_fourier = false;
        choice.alternative.clear();
      }
  }



  template void
  Run<2>::balance_harmonics();
  template void
  Run<3>::balance_harmonics();
  template void
  Run<2>::take_flow_of_samples();
  template void
  Run<3>::take_flow_of_samples();
  template void
  Run<2>::find_secular_flow();
  template void
  Run<3>::find_secular_flow();
} // namespace Crevasse
