// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/linear/mumps_instance.h>
#include <crevasse/simulation/workspace.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Finds the secular flow; if it fails, continues without it, or throws. */
    template <int dim>
    void
    find_secular_flow(Workspace<dim> &work)
    {
      PeriodicStart  &start = work.start;
      const Stopwatch phase("secular problem");
      SecularSplit   &split = start.split;
      try
        {
          start.flow = solve_secular_problem(work.setup.body,
                                             split.mean_load,
                                             work.systems);
        }
      catch (const NumericalError &error)
        {
          end_abandoned_factors();
          const std::string what =
            std::string(
              "the stationary contact problem for beta, with viscosity instead "
              "of stiffness, was not solved: ") +
            error.what();
          if (work.setup.scene.periodic_state.secular_split ==
              SecularSplitType::on)
            throw NumericalError("[Periodic state] Secular split = on: " +
                                 what);
          if (split.is_split && !start.choice.may_fall_back)
            throw NumericalError(
              what +
              " Use [Periodic state] Method = march, which does not need it.");
          if (split.is_split)
            start.choice = {PeriodicMethodType::march,
                            false,
                            true,
                            "automatic: the flow was not found",
                            {}};
          // The rest of the run does not need the flow.
          split.is_split = split.strain_returns = split.effect.on = false;
          split.effect.why                                        = what;
          work.output.log.line("  warning: " + what);
        }
    }



    /** Sets the flow of the samples as the flow of the run. */
    void
    take_flow(PeriodicStart &start, Log &log)
    {
      const bool flows     = start.direct->flow.has_value();
      start.flow           = start.direct->flow;
      start.split.is_split = flows;
      if (flows && !start.split.effect.on)
        {
          start.split.effect.why =
            "the mean load vanishes, but the mean of its samples does not";
          start.warnings.emplace_back(
            "[Time integration] Steps per period: the mean load vanishes, but "
            "the mean of its samples does not: the secular flow is an error of "
            "the steps");
          log.line("  warning: " + start.warnings.back());
        }
      start.split.effect.on = flows;
    }



    template <int dim>
    void
    balance_harmonics(Workspace<dim> &work)
    {
      const RunSetup<dim> &setup = work.setup;
      PeriodicStart       &start = work.start;
      Log                 &log   = work.output.log;
      const Stopwatch      phase("harmonic balance");
      try
        {
          FourierResult result =
            solve_fourier_problem(setup.scene,
                                  setup.body,
                                  setup.steps,
                                  work.systems,
                                  setup.relaxation_times.smallest);
          log.line(result.describe());
          for (const std::string &warning : result.warnings)
            log.line("  warning: " + warning);
          start.warnings = result.warnings;
          if (start.choice.method != PeriodicMethodType::fourier)
            {
              // Another method needs only the beginning of the motion.
              result.motion.viscous_strain.resize(1);
              result.motion.displacement.clear();
              result.motion.contact_forces.clear();
            }
          start.direct = std::move(result);
        }
      catch (const NumericalError &error)
        {
          if (!start.choice.may_fall_back)
            throw;
          end_abandoned_factors();
          log.line("  warning: harmonic balance failed, anderson takes over: " +
                   std::string(error.what()));
          start.choice.method              = PeriodicMethodType::anderson;
          start.choice.starts_from_fourier = false;
          start.choice.alternative.clear();
        }
    }
  } // namespace



  template <int dim>
  void
  find_periodic_start(Workspace<dim> &work)
  {
    PeriodicStart &start = work.start;
    if (start.choice.uses_fourier())
      balance_harmonics(work);
    if (start.direct && start.choice.method == PeriodicMethodType::fourier)
      take_flow(start, work.output.log);
    else if (start.split.effect.on)
      find_secular_flow(work);
  }



  template decltype(find_periodic_start<2>) find_periodic_start<2>;
  template decltype(find_periodic_start<3>) find_periodic_start<3>;
} // namespace Crevasse
