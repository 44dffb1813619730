// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/libraries.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/base/version.h>
#include <crevasse/model/jumps.h>
#include <crevasse/model/linear_choice.h>
#include <crevasse/parameters/formulas_of_scene.h>
#include <crevasse/parameters/unused_parameters.h>
#include <crevasse/simulation/simulation.h>
#include <crevasse/simulation/sizes.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  void
  Simulation<dim>::describe() const
  {
    if (!scene.title.empty())
      log.line(scene.title);
    describe_sizes(body, steps, scene, periodic_choice, log);
    log.line("  boundaries: " + describe_boundaries<dim>(scene));
    for (const Effects::Effect &effect : effects())
      {
        std::ostringstream text;
        text << "  " << std::left << std::setw(19) << effect.name
             << std::setw(4) << (effect.on ? "on" : "off") << '('
             << Text::shorten(effect.why) << ')';
        log.line(text.str());
      }
    std::ostringstream time;
    if (scene.time_integration.step_control == StepControlType::adaptive)
      time << "  time: adaptive steps, relative tolerance "
           << scene.time_integration.relative_tolerance
           << ", at first none longer than " << steps.largest_step();
    else
      time << "  time: " << steps.n_steps() << " steps a period, the largest "
           << steps.largest_step();
    if (integrator != nullptr)
      {
        const double limit =
          integrator->stability_limit() * relaxation_times.smallest;
        time << "; " << integrator->description() << ", stable ";
        if (std::isfinite(limit))
          time << "below " << limit;
        else
          time << "with any step";
      }
    log.line(time.str());
    log.line("  periodic state: " + periodic_choice.describe());
    const LinearSolverChoice  linear = choose_linear_solver(scene, body);
    const ContactSolverChoice contact =
      choose_contact_solver(scene, body, linear);
    if (!traits(contact.type).relaxes)
      log.line("  linear solver: " + linear.describe());
    if (body.effects.contact.on)
      log.line("  contact solver: " + contact.describe());
    if (crack_tip != nullptr)
      log.line(crack_tip->describe());
    describe_decay();
    for (const std::string &warning : warnings())
      log.line("  warning: " + warning);
  }



  template <int dim>
  void
  Simulation<dim>::describe_decay() const
  {
    const double tolerance = scene.periodic_state.tolerance;
    if (body.effects.contact.on || integrator == nullptr ||
        body.law.has_spring() || tolerance == 0. || !relaxation_times.all ||
        periodic_choice.method == PeriodicMethodType::fourier ||
        body.effects.varying_stiffness.on ||
        body.effects.varying_viscosity.on ||
        steps.largest_step() > 2. * relaxation_times.smallest)
      return;
    // What differs from the periodic stress does no work: its energy falls at
    // least as fast as that of the slowest point.
    std::ostringstream text;
    text << "  without contact the stress is periodic to " << tolerance
         << ", in the norm of its energy, within "
         << std::ceil(-std::log(tolerance) * relaxation_times.largest /
                      scene.loads.period)
         << " periods (slowest relaxation time " << relaxation_times.largest
         << ')';
    log.line(text.str());
  }



  template <int dim>
  std::vector<Effects::Effect>
  Simulation<dim>::effects() const
  {
    Effects all      = body.effects;
    all.secular_flow = secular_split.effect;
    return all.list();
  }



  template <int dim>
  std::vector<std::string>
  Simulation<dim>::warnings() const
  {
    std::vector<std::string> all   = unused_parameters(scene);
    constexpr double         small = 0.1;
    if (largest_thermal_strain > small)
      {
        std::ostringstream text;
        text << "[Material] Thermal expansion and [Loads] Temperature: the "
                "thermal strain is up to "
             << largest_thermal_strain
             << "; the theory is one of small strains, much less than 1";
        all.push_back(text.str());
      }
    constexpr double      too_much = 0.5;
    const StepControlType control  = scene.time_integration.step_control;
    if (missed_load > too_much && control != StepControlType::adaptive)
      {
        std::ostringstream text;
        text << "[Time integration]: within a step the loads differ by "
             << std::lround(100. * missed_load)
             << " % of their largest from a straight line between its ends; "
                "steps that are too few, or that meet a load at its zeros, "
             << (integrator == nullptr
                   ? "show another load than the scene's. "
                   : "compute with another load than the scene's. ")
             << (control == StepControlType::list ? "Add instants to Steps"
                                                  : "Raise Steps per period");
        all.push_back(text.str());
      }
    if (steps.jumps_at(steps.period()) && !formulas_can_jump(scene))
      all.push_back(
        "[Loads] Period = " + Text::from_number(steps.period()) +
        ": loads or material jump where the period ends and t begins anew, "
        "though no formula has a jump in it. Is this the period of the "
        "formulas?");
    if (scene.discretisation.singular_functions == 3 && body.effects.contact.on)
      all.push_back(
        "[Discretisation] Singular functions = 3 with contact: where the lip "
        "is pressed, the third one moves it between its nodes, and pressure "
        "and K_I are off by some tenths of a per cent; 2 are not");
    if (!secular_split.warning.empty())
      all.push_back(secular_split.warning);
    if (integrator != nullptr && !periodic_choice.uses_fourier() &&
        scene.time_integration.scheme == Scheme::trapezoid &&
        steps.largest_step() > 2. * relaxation_times.smallest)
      {
        std::ostringstream text;
        text << "[Time integration] Scheme = trapezoid with steps of "
             << steps.largest_step() / relaxation_times.smallest
             << " relaxation times: what relaxes so fast swings on instead of "
                "dying out; Scheme = sdirk2 lets it die";
        all.push_back(text.str());
      }
    if (integrator != nullptr &&
        scene.time_integration.scheme == Scheme::exponential &&
        scene.time_integration.step_control != StepControlType::adaptive &&
        steps.largest_step() > 2. * relaxation_times.smallest)
      {
        std::ostringstream text;
        text << "[Time integration] Scheme = exponential with steps of "
             << steps.largest_step() / relaxation_times.smallest
             << " relaxation times is stable, but what creeps under given "
                "loads creeps by about one elastic strain a step at most; "
                "Scheme = sdirk2 is exact there";
        all.push_back(text.str());
      }
    return all;
  }



  template <int dim>
  void
  Simulation<dim>::summarise_secular_flow(Summary &summary) const
  {
    auto &secular  = summary["secular"];
    secular["on"]  = secular_split.effect.on;
    secular["why"] = secular_split.effect.why;
    if (!secular_flow)
      {
        // Measured: what the displacement gains over a period.
        if (!body.effects.viscosity.on)
          return;
        secular["largest_rate"] = summary["drift"]["largest_rate"];
        for (const auto &probe : probes)
          secular["per_probe"][probe.name()]["beta"] =
            summary["drift"]["per_probe"][probe.name()];
        return;
      }

    State mean;
    mean.displacement       = secular_flow->velocity;
    mean.contact_forces     = secular_flow->contact_forces;
    secular["largest_rate"] = mean.displacement.linfty_norm();
    double force            = 0.;
    for (std::size_t k = 0; k < body.lip.nodes().size(); ++k)
      force += body.lip.nodes()[k].force(mean.contact_forces[k]);
    secular["contact_force"] = Utilities::MPI::sum(force, communicator);
    for (const auto &probe : probes)
      {
        auto      &entry = secular["per_probe"][probe.name()];
        const auto beta  = probe.displacement(mean.displacement);
        for (unsigned int d = 0; d < dim; ++d)
          entry["beta"].push_back(beta[d]);
        const double pressure = probe.opening_and_pressure(mean)[1];
        if (probe.on_lip())
          entry["mean_pressure"] = pressure;
      }
  }



  template <int dim>
  void
  Simulation<dim>::summarise_steps(Summary &summary) const
  {
    if (integrator == nullptr)
      return;
    IntegratorStatistics statistics = integrator->statistics();
    for (const auto &entry : step_control->statistics())
      statistics.push_back(entry);
    if (statistics.empty())
      return;
    std::string text;
    for (const auto &[name, number] : statistics)
      {
        summary["time_integration"][name] = number;
        std::string words                 = name;
        std::replace(words.begin(), words.end(), '_', ' ');
        text +=
          (text.empty() ? "  " : ", ") + std::to_string(number) + ' ' + words;
      }
    log.line("");
    log.line(text);
  }



  template <int dim>
  void
  Simulation<dim>::summarise(Summary &summary, Solvers<dim> &solvers) const
  {
    summary["version"]   = CREVASSE_VERSION;
    summary["git"]       = CREVASSE_GIT_REVISION;
    summary["libraries"] = library_versions();
    summary["dimension"] = dim;
    Sizes(body).add_to(summary);
    for (const Effects::Effect &effect : effects())
      summary["effects"][effect.name] = {{"on", effect.on},
                                         {"why", effect.why}};

    summary["periodic_method"]            = periodic_choice.describe();
    std::vector<std::string> all_warnings = warnings();
    all_warnings.insert(all_warnings.end(),
                        direct_warnings.begin(),
                        direct_warnings.end());
    summary["warnings"] = all_warnings;

    solvers.summarise(summary);
    summary["counters"]["rate_evaluations"] = rate_evaluations;
    summarise_steps(summary);

    const SolverStatistics statistics = solvers.statistics();
    if (statistics.certified == 0)
      return; // nothing to certify
    log.line("");
    std::ostringstream accepted;
    accepted << std::setprecision(2) << statistics.accuracy;
    log.line("  certificate of " + std::to_string(statistics.certified) +
             " solves: " + statistics.certificate.describe() +
             " (accepted up to " + accepted.str() + ")");
    constexpr double poor = 1e-6;
    if (statistics.accuracy > std::max(poor, scene.contact.tolerance))
      log.line(
        "  Beware: the stiffness is badly conditioned. Rounding leaves "
        "an accuracy of " +
        Text::from_number(statistics.accuracy) +
        " only, not [Contact] Tolerance = " +
        Text::from_number(scene.contact.tolerance) +
        ". Very flat cells, a Poisson ratio close to its limits or moduli "
        "that differ by many orders of magnitude do this.");
  }



#define INSTANTIATE(dim)                                                         \
  template void                         Simulation<dim>::describe() const;       \
  template void                         Simulation<dim>::describe_decay() const; \
  template std::vector<Effects::Effect> Simulation<dim>::effects() const;        \
  template std::vector<std::string>     Simulation<dim>::warnings() const;       \
  template void Simulation<dim>::summarise_secular_flow(Summary &) const;        \
  template void Simulation<dim>::summarise_steps(Summary &) const;               \
  template void Simulation<dim>::summarise(Summary &, Solvers<dim> &) const

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
