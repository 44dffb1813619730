// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/model/jumps.h>
#include <crevasse/parameters/effects.h>
#include <crevasse/simulation/setup_report.h>
#include <crevasse/simulation/sizes.h>

#include <cmath>
#include <iomanip>
#include <sstream>

namespace Crevasse
{
  namespace
  {
    /** A-priori bound of the periods that a march takes, where there is one. */
    template <int dim>
    void
    describe_decay(const RunSetup<dim> &setup, Log &log)
    {
      const double tolerance = setup.scene.periodic_state.tolerance;
      if (setup.body.effects.contact.on || setup.integrator == nullptr ||
          setup.body.law.has_spring() || tolerance == 0. ||
          !setup.relaxation_times.all ||
          setup.periodic_choice.method == PeriodicMethodType::fourier ||
          setup.body.effects.varying_stiffness.on ||
          setup.body.effects.varying_viscosity.on ||
          setup.steps.largest_step() > 2. * setup.relaxation_times.smallest)
        return;
      // What differs from the periodic stress does no work: its energy falls at
      // least as fast as that of the slowest point.
      std::ostringstream text;
      text << "  without contact the stress is periodic to " << tolerance
           << ", in the norm of its energy, within "
           << std::ceil(-std::log(tolerance) * setup.relaxation_times.largest /
                        setup.scene.loads.period)
           << " periods (slowest relaxation time "
           << setup.relaxation_times.largest << ')';
      log.line(text.str());
    }



    /** Schemes that are stable, but not accurate, with such steps. */
    template <int dim>
    void
    warn_of_large_steps(const RunSetup<dim>      &setup,
                        const PeriodicChoice     &choice,
                        std::vector<std::string> &all)
    {
      const TimeIntegrationParameters &time = setup.scene.time_integration;
      const double                     in_relaxation_times =
        setup.steps.largest_step() / setup.relaxation_times.smallest;
      if (setup.integrator == nullptr || in_relaxation_times <= 2.)
        return;
      if (!choice.uses_fourier() && time.scheme == Scheme::trapezoid)
        {
          std::ostringstream text;
          text << "[Time integration] Scheme = trapezoid with steps of "
               << in_relaxation_times
               << " relaxation times: what relaxes so fast oscillates instead "
                  "of decaying; with Scheme = sdirk2 it decays";
          all.push_back(text.str());
        }
      if (time.scheme == Scheme::exponential &&
          time.step_control != StepControlType::adaptive)
        {
          std::ostringstream text;
          text << "[Time integration] Scheme = exponential with steps of "
               << in_relaxation_times
               << " relaxation times is stable, but what creeps under given "
                  "loads creeps by about one elastic strain a step at most; "
                  "Scheme = sdirk2 is exact there";
          all.push_back(text.str());
        }
    }
  } // namespace



  template <int dim>
  std::vector<std::string>
  warnings(const RunSetup<dim>  &setup,
           const PeriodicChoice &choice,
           const SecularSplit   &split)
  {
    std::vector<std::string> all   = unused_parameters(setup.scene);
    constexpr double         small = 0.1;
    if (setup.largest_thermal_strain > small)
      {
        std::ostringstream text;
        text << "[Material] Thermal expansion and [Loads] Temperature: the "
                "thermal strain is up to "
             << setup.largest_thermal_strain
             << "; the theory is one of small strains, much less than 1";
        all.push_back(text.str());
      }
    constexpr double      too_much = 0.5;
    const StepControlType control  = setup.scene.time_integration.step_control;
    if (setup.missed_load > too_much && control != StepControlType::adaptive)
      {
        std::ostringstream text;
        text << "[Time integration]: within a step the loads differ by "
             << std::lround(100. * setup.missed_load)
             << " % of their largest from a straight line between its ends; "
                "steps that are too few, or that meet a load at its zeros, "
             << (setup.integrator == nullptr
                   ? "show another load than the scene's. "
                   : "compute with another load than the scene's. ")
             << (control == StepControlType::list ? "Add instants to Steps"
                                                  : "Raise Steps per period");
        all.push_back(text.str());
      }
    if (setup.steps.jumps_at(setup.steps.period()) &&
        !formulas_can_jump(setup.scene))
      all.push_back(
        "[Loads] Period = " + Text::from_number(setup.steps.period()) +
        ": loads or material jump where the period ends and t begins anew, "
        "though no formula has a jump in it. Is this the period of the "
        "formulas?");
    if (setup.scene.discretisation.singular_functions == 3 &&
        setup.body.effects.contact.on)
      all.push_back(
        "[Discretisation] Singular functions = 3 with contact: where the lip "
        "is pressed, the third one moves it between its nodes, and pressure "
        "and K_I are off by some tenths of a per cent; 2 are not");
    if (!split.warning.empty())
      all.push_back(split.warning);
    warn_of_large_steps(setup, choice, all);
    return all;
  }



  template <int dim>
  void
  describe(const RunSetup<dim> &setup, Log &log)
  {
    if (!setup.scene.title.empty())
      log.line(setup.scene.title);
    describe_sizes(setup, log);
    log.line("  boundaries: " + describe_boundaries<dim>(setup.scene));
    for (const Effects::Effect &effect :
         setup.active_effects(setup.secular_split))
      {
        std::ostringstream text;
        text << "  " << std::left << std::setw(19) << effect.name
             << std::setw(4) << (effect.on ? "on" : "off") << '('
             << Text::shorten(effect.why) << ')';
        log.line(text.str());
      }
    std::ostringstream time;
    if (setup.scene.time_integration.step_control == StepControlType::adaptive)
      time << "  time: adaptive steps, relative tolerance "
           << setup.scene.time_integration.relative_tolerance
           << ", at first none longer than " << setup.steps.largest_step();
    else
      time << "  time: " << setup.steps.n_steps()
           << " steps a period, the largest " << setup.steps.largest_step();
    if (setup.integrator != nullptr)
      {
        const double limit =
          setup.integrator->stability_limit() * setup.relaxation_times.smallest;
        time << "; " << setup.integrator->description() << ", stable ";
        if (std::isfinite(limit))
          time << "below " << limit;
        else
          time << "with any step";
      }
    log.line(time.str());
    log.line("  periodic state: " + setup.periodic_choice.describe());
    if (!traits(setup.solvers.contact.type).relaxes)
      log.line("  linear solver: " + setup.solvers.linear.describe());
    if (setup.body.effects.contact.on)
      log.line("  contact solver: " + setup.solvers.contact.describe());
    if (setup.crack_tip != nullptr)
      log.line(setup.crack_tip->describe());
    describe_decay(setup, log);
    for (const std::string &warning :
         warnings(setup, setup.periodic_choice, setup.secular_split))
      log.line("  warning: " + warning);
  }



#define INSTANTIATE(dim)                                                  \
  template std::vector<std::string> warnings<dim>(const RunSetup<dim> &,  \
                                                  const PeriodicChoice &, \
                                                  const SecularSplit &);  \
  template void                     describe<dim>(const RunSetup<dim> &, Log &)

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
