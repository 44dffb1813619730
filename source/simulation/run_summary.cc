// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/libraries.h>
#include <crevasse/base/machine_memory.h>
#include <crevasse/base/text.h>
#include <crevasse/base/version.h>
#include <crevasse/simulation/run_summary.h>
#include <crevasse/simulation/setup_report.h>
#include <crevasse/simulation/sizes.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cstdio>
#include <iomanip>
#include <sstream>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** What integrator and step control have counted. */
    template <int dim>
    void
    summarise_steps(const Workspace<dim> &work, Log &log, Summary &summary)
    {
      if (work.integrator == nullptr)
        return;
      IntegratorStatistics statistics = work.integrator->statistics();
      for (const auto &entry : work.step_control->statistics())
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



    void
    describe_certificate(const SolverStatistics &statistics,
                         const double            tolerance,
                         Log                    &log)
    {
      if (statistics.certified == 0)
        return; // nothing to certify
      log.line("");
      std::ostringstream accepted;
      accepted << std::setprecision(2) << statistics.accuracy;
      log.line("  certificate of " + std::to_string(statistics.certified) +
               " solves: " + statistics.certificate.describe() +
               " (accepted up to " + accepted.str() + ")");
      constexpr double poor = 1e-6;
      if (statistics.accuracy > std::max(poor, tolerance))
        log.line(
          "  Beware: the stiffness is badly conditioned. Rounding leaves "
          "an accuracy of " +
          Text::from_number(statistics.accuracy) +
          " only, not [Contact] Tolerance = " + Text::from_number(tolerance) +
          ". Very flat cells, a Poisson ratio close to its limits or moduli "
          "that differ by many orders of magnitude do this.");
    }
  } // namespace



  template <int dim>
  void
  summarise_run(const RunSetup<dim>  &setup,
                const Workspace<dim> &work,
                const RunState       &state,
                Log                  &log,
                Summary              &summary)
  {
    summary["version"]   = CREVASSE_VERSION;
    summary["git"]       = CREVASSE_GIT_REVISION;
    summary["libraries"] = library_versions();
    summary["dimension"] = dim;
    Sizes(setup.body).add_to(summary);
    for (const Effects::Effect &effect : setup.active_effects(work.start.split))
      summary["effects"][effect.name] = {{"on", effect.on},
                                         {"why", effect.why}};

    summary["periodic_method"] = work.start.choice.describe();
    std::vector<std::string> all_warnings =
      warnings(setup, work.start.choice, work.start.split);
    all_warnings.insert(all_warnings.end(),
                        work.start.warnings.begin(),
                        work.start.warnings.end());
    summary["warnings"] = all_warnings;

    work.systems.summarise(summary);
    summary["counters"]["rate_evaluations"] =
      state.rate_evaluations + work.evolution.n_rate_evaluations();
    summarise_steps(work, log, summary);
    describe_certificate(work.systems.statistics(),
                         setup.scene.contact.tolerance,
                         log);
  }



  template <int dim>
  void
  summarise_secular_flow(const RunSetup<dim> &setup,
                         const PeriodicStart &start,
                         Summary             &summary)
  {
    auto &secular  = summary["secular"];
    secular["on"]  = start.split.effect.on;
    secular["why"] = start.split.effect.why;
    if (!start.flow)
      {
        // Measured: what the displacement gains over a period.
        if (!setup.body.effects.viscosity.on)
          return;
        secular["largest_rate"] = summary["drift"]["largest_rate"];
        for (const auto &probe : setup.probes)
          secular["per_probe"][probe.name()]["beta"] =
            summary["drift"]["per_probe"][probe.name()];
        return;
      }

    State mean;
    mean.displacement       = start.flow->velocity;
    mean.contact_forces     = start.flow->contact_forces;
    secular["largest_rate"] = mean.displacement.linfty_norm();
    double force            = 0.;
    for (std::size_t k = 0; k < setup.body.lip.nodes().size(); ++k)
      force += setup.body.lip.nodes()[k].force(mean.contact_forces[k]);
    secular["contact_force"] =
      Utilities::MPI::sum(force, setup.body.space.communicator());
    for (const auto &probe : setup.probes)
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



  void
  write_summary(const RunState  &state,
                const MPI_Comm   communicator,
                const RunOutput &output,
                Summary         &summary)
  {
    const PeriodicResult &result     = state.result;
    summary["stress_change"]         = result.stress_change;
    summary["stress_error_estimate"] = result.stress_error_estimate;
    summary["periods"]               = result.periods;
    summary["converged"]             = // null: nothing was marched
      result.periods > 0 ? Summary(result.converged) : Summary();
    const double total = state.seconds.at("total");
    for (const auto &[name, seconds] : state.seconds)
      if (name != "total")
        summary["seconds"][name] = seconds;
    summary["seconds"]["total"] = total;
    summary["processor_seconds"] =
      Utilities::MPI::max(state.timer.cpu_time(), communicator);
    const std::vector<double> peaks = peak_memory_of_ranks(communicator);
    if (!peaks.empty())
      {
        summary["peak_memory_bytes"] =
          *std::max_element(peaks.begin(), peaks.end());
        summary["peak_memory_bytes_of_ranks"] = peaks;
      }
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      write_summary(summary, output.directory + "/summary.json");

    char text[80];
    std::snprintf(text, sizeof(text), "  Time = %.2f s", total);
    output.log.line(text);
  }



#define INSTANTIATE(dim)                                           \
  template void summarise_run<dim>(const RunSetup<dim> &,          \
                                   const Workspace<dim> &,         \
                                   const RunState &,               \
                                   Log &,                          \
                                   Summary &);                     \
  template void summarise_secular_flow<dim>(const RunSetup<dim> &, \
                                            const PeriodicStart &, \
                                            Summary &)

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
