// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/environment.h>
#include <crevasse/base/machine_memory.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/base/text_file.h>
#include <crevasse/base/version.h>
#include <crevasse/parameters/automatic.h>
#include <crevasse/parameters/units.h>
#include <crevasse/simulation/common_errors.h>
#include <crevasse/simulation/run.h>
#include <crevasse/simulation/setup_report.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Summarises the counts of integrator and step control. */
    template <int dim>
    void
    summarise_steps(const Run<dim> &run, Summary &summary)
    {
      if (run.integrator == nullptr)
        return;
      const IntegratorStatistics statistics = run.integrator->statistics();
      if (statistics.empty())
        return;
      std::vector<std::string> parts;
      for (const auto &[name, number] : statistics)
        {
          summary["time_integration"][name] = number;
          parts.push_back(std::to_string(number) + ' ' + name);
          std::replace(parts.back().begin(), parts.back().end(), '_', ' ');
        }
      run.log.line("\n  " + Text::join(parts, ", "));
    }



    void
    describe_certificate(const SolverStatistics &statistics,
                         const Scene            &scene,
                         Log                    &log,
                         Summary                &summary)
    {
      const double tolerance = scene.contact.tolerance;
      if (statistics.certified == 0)
        return; // nothing to certify
      log.line("\n  certificate of " + std::to_string(statistics.certified) +
               " solves: " + statistics.certificate.describe() +
               Text::format(" (accepted up to %.2g)", statistics.accuracy));
      if (statistics.implicit_stages > 0)
        log.line(
          Text::format("  Newton's method: residual %.3g (accepted up to %.2g)",
                       statistics.certificate.newton_residual,
                       scene.time_integration.newton_tolerance));
      if (statistics.undetermined > 0)
        log.line("  In " + std::to_string(statistics.undetermined) +
                 " of them the position of parts that contact alone holds is "
                 "undetermined: their displacement is one of many.");
      constexpr double poor = 1e-6;
      if (statistics.accuracy > std::max(poor, tolerance))
        warn(
          "the stiffness is badly conditioned. Rounding limits the accuracy "
          "to " +
            Text::from_number(statistics.accuracy, 3) +
            " instead of [Contact] Tolerance = " +
            Text::from_number(tolerance) +
            ". Causes are very flat cells, a Poisson ratio close to its "
            "limits, or moduli that differ by many orders of magnitude",
          log,
          summary);
    }



    /** Summarises what was computed and how: versions, sizes, effects, choices,
     * warnings and counters. Collective. */
    template <int dim>
    void
    summarise_run(const Run<dim> &run, Summary &summary)
    {
      summary["version"]     = CREVASSE_VERSION;
      summary["git"]         = CREVASSE_GIT_REVISION;
      summary["libraries"]   = library_versions();
      summary["environment"] = environment(run.scene.output.command_line);
      summary["dimension"]   = dim;
      if (const Units units(run.scene.units); units.are_known())
        summary["units"] = {{"length", units.length.name},
                            {"stress", units.stress.name},
                            {"time", units.time.name},
                            {"temperature", units.temperature.name},
                            {"K_in_MPa_sqrt_m", units.intensity_in_MPa()}};
      summary.update(sizes_of(run.body));
      if (run.scene.geometry.shape != Shape::mesh_file)
        summary["subdivisions"] = subdivisions(run.scene.geometry, dim);
      for (const Effects::Effect &effect : run.active_effects())
        summary["effects"][effect.name] = {{"on", effect.on},
                                           {"why", effect.why}};

      summary["periodic_method"]            = run.choice.describe();
      std::vector<std::string> all_warnings = warnings(run);
      all_warnings.insert(all_warnings.end(),
                          run.later_warnings.begin(),
                          run.later_warnings.end());
      summary["warnings"] = all_warnings;
      for (const std::string &warning : table_warnings(run))
        warn(warning, run.log, summary);
      for (const auto &errors : {common_errors(run), missed_rows(run)})
        for (const CommonError &error : errors)
          summary["no_limit"][error.part] = error.why;
      // Before the observers' summaries, which solve more problems.
      run.evolution.statistics().add_counters(summary);
      summarise_steps(run, summary);
    }



    /** Adds results and cost of the periods to the summary, and writes it.
     * Collective. @throw FileError */
    template <int dim>
    void
    summarise_results(const Run<dim> &run, Summary &summary)
    {
      const RunState        &state        = run.state;
      const PeriodicResult  &result       = state.result;
      const MPI_Comm         communicator = run.body.space.communicator();
      const SolverStatistics statistics   = run.evolution.statistics();
      run.systems.describe(summary);
      statistics.add_certificate(summary);
      describe_certificate(statistics, run.scene, run.log, summary);
      // Tips without K follow tips with tables, which are numbered.
      for (const Summary &tip : run.tips_without_intensity)
        summary["crack_tips"].push_back(tip);
      if (run.direct)
        run.direct->add_to(summary);
      // --resume compares this scene with the current one.
      summary["scene"]                 = run.checkpoints.scene;
      summary["stress_change"]         = result.stress_change;
      summary["stress_error_estimate"] = result.stress_error_estimate;
      summary["periods"]               = result.periods;
      const bool has_missions = !run.scene.periodic_state.missions.empty();
      summary["converged"]    = // null: no periodic state was sought
        result.periods > 0 && !has_missions ? Summary(result.converged)
                                               : Summary();
      if (has_missions)
        summary["missions"] = result.missions;
      const double seconds = report_meters(run.log, summary);
      summary["processor_seconds"] =
        Utilities::MPI::sum(state.timer.cpu_time(), communicator);
      const std::vector<double> peaks = peak_memory_of_ranks(communicator);
      if (!peaks.empty())
        {
          summary["peak_memory_bytes"] =
            *std::max_element(peaks.begin(), peaks.end());
          summary["peak_memory_bytes_of_ranks"] = peaks;
        }
      if (Utilities::MPI::this_mpi_process(communicator) == 0)
        write_atomically(summary.dump(2) + '\n',
                         run.checkpoints.directory + "/summary.json");
      run.log.line(Text::format("  Time = %.2f s", seconds));
    }



    /** Logs after which period the change of stress was within the tolerance,
     * the criterion of the paper, unless that is the last period. */
    void
    report_end_by_change(const PeriodicResult &result,
                         const double          tolerance,
                         Log                  &log)
    {
      if (tolerance == 0.)
        return;
      for (unsigned int k = 1; k + 1 < result.periods; ++k)
        if (result.stress_change[k] <= tolerance)
          {
            const double  error = result.stress_error_estimate[k];
            Text::Message text;
            text << "  The change of stress alone (the paper's test) would "
                    "have ended the march after "
                 << k + 1 << " periods";
            if (std::isfinite(error))
              text << ", with an estimated error of " << error;
            log.line(text << '.');
            return;
          }
    }



    void
    require_meaning(const double stress_rounding, const bool is_split, Log &log)
    {
      constexpr double  doubtful = 1e-6, worthless = 1e-2;
      const std::string text =
        Text::Message()
        << "Rounding leaves errors of " << stress_rounding
        << " of its maximum in the stress, the stiffness times the difference "
           "of total and viscous strain: the body has flowed too far, or is "
           "nearly incompressible (Poisson ratio near 0.5). "
        << (is_split ? "Check"
                     : "Split off the mean flow ([Periodic state] Secular "
                       "split = on), or check")
        << " whether relaxation times are many orders below the period, and "
           "the Poisson ratios.";
      if (stress_rounding > worthless)
        throw NumericalError(text);
      if (stress_rounding > doubtful)
        log.line("  Beware: " + text);
    }
  } // namespace



  template <int dim>
  void
  Run<dim>::conclude(Summary summary)
  {
    summarise_run(*this, summary);
    if (closure != nullptr)
      closure->find_changes(observers);
    for (const auto &observer : observers)
      {
        observer->summarise(summary);
        observer->finish();
      }
    const PeriodicResult &result = state.result;
    if (result.converged && choice.periods_are_iterates() &&
        summary.value("closed_part", Summary()) ==
          Summary{{"wholly", 0.}, {"partly", 0.}})
      warn(
        "no lip touches in the periodic state. How far it opens depends on "
        "the way from rest, which this method does not follow; Method = "
        "march does",
        log,
        summary);
    summarise_results(*this, summary);

    if (result.periods == 0)
      return;
    const PeriodicStateParameters &parameters = scene.periodic_state;
    if (body.effects.viscosity.on)
      require_meaning(summary["certificate"]["stress_rounding"],
                      split.is_split,
                      log);
    if (choice.method == PeriodicMethodType::march)
      report_end_by_change(result, parameters.tolerance, log);
    if (!parameters.missions.empty())
      {
        if (!result.has_all_missions)
          throw NumericalError(choice.message_of_failure(parameters, result));
        return;
      }
    if (!result.converged && parameters.tolerance > 0.)
      throw NumericalError(choice.message_of_failure(parameters, result));
    if (result.converged)
      for (const auto &observer : observers)
        observer->require_periodic();
  }



  template void Run<2>::conclude(Summary);
  template void Run<3>::conclude(Summary);
} // namespace Crevasse
