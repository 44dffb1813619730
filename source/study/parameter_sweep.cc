// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/base/version.h>
#include <crevasse/study/history.h>
#include <crevasse/study/parameter_sweep.h>
#include <crevasse/study/sweep_run.h>

#include <algorithm>
#include <filesystem>
#include <functional>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    bool
    want_stress(const std::vector<Quantity> &quantities)
    {
      return std::any_of(quantities.begin(),
                         quantities.end(),
                         [](const Quantity &quantity) {
                           return quantity.is_stress_field();
                         });
    }



    /** Whether a run has marched at all; only then there are tables. */
    bool
    has_periods(const SweepResult &result)
    {
      return result.costs.value("periods", 0) > 0;
    }



    bool
    marches_from_rest(const Scene &scene)
    {
      return scene.periodic_state.method == PeriodicMethodType::march &&
             scene.periodic_state.start_from == StartFrom::rest;
    }



    /** Ends the sweep as the reference run would have ended by itself. */
    [[noreturn]] void
    throw_of_reference(const std::exception_ptr &exception)
    {
      const std::string what = "The reference run: ";
      try
        {
          std::rethrow_exception(exception);
        }
      catch (const SceneError &error)
        {
          throw SceneError(what + error.what());
        }
      catch (const std::exception &error)
        {
          throw NumericalError(what + error.what());
        }
    }
  } // namespace



  ParameterSweep::ParameterSweep(const Command &command,
                                 const MPI_Comm for_failures,
                                 StopRequests  &requests,
                                 Log           &log)
    : command(command)
    , communicator(MPI_COMM_WORLD)
    , for_failures(for_failures)
    , requests(requests)
    , log(log)
    , first_rank(Utilities::MPI::this_mpi_process(communicator) == 0)
    , plan(command.sweep_request)
    , scenes(command, plan)
  {
    std::vector<const Scene *> all = {&scenes.reference.scene};
    for (const SweepVariant &point : scenes.points)
      all.push_back(&point.scene);
    quantities = choose_quantities(command.sweep_request, all);
    directory  = directory_of_sweep(command, scenes.reference.scene);
    table      = std::make_unique<SweepTable>(
      plan,
      quantities,
      "Sweep of " +
        std::filesystem::path(command.scene_file).filename().string(),
      describe_reference());
  }



  bool
  ParameterSweep::needs_reference() const
  {
    return std::any_of(quantities.begin(),
                       quantities.end(),
                       [](const Quantity &quantity) {
                         return quantity.exact == nullptr;
                       });
  }



  std::string
  ParameterSweep::describe_reference() const
  {
    std::vector<std::string> parts;
    if (needs_reference())
      parts.push_back("the run with " +
                      Text::join(command.sweep_request.reference, ", "));
    for (const Quantity &quantity : quantities)
      if (quantity.exact != nullptr)
        parts.push_back(quantity.name + " = " + quantity.exact->formula());
    return "Errors are measured against " + Text::join(parts, "; ");
  }



  std::string
  ParameterSweep::basis() const
  {
    std::string text;
    for (const Quantity &quantity : quantities)
      text +=
        quantity.name +
        (quantity.exact != nullptr ? " = " + quantity.exact->formula() : "") +
        "; ";
    if (needs_reference())
      text += scenes.reference.used;
    return std::to_string(std::hash<std::string>()(text));
  }



  void
  ParameterSweep::run()
  {
    const auto lock = take_sweep_directory(directory, communicator);
    log.open_file(directory + "/sweep.log");
    log.line("Crevasse " CREVASSE_VERSION ": sweep of " +
             std::filesystem::path(command.scene_file).filename().string() +
             ", " + std::to_string(scenes.points.size()) +
             (scenes.points.size() == 1 ? " point" : " points"));
    log.line("  " + describe_reference());
    const auto of_problem = plan.parameters_of_problem();
    if (needs_reference() && !of_problem.empty())
      log.line("  note: " + Text::join(of_problem, ", ") +
               " changes the problem itself: errors against one reference "
               "tell how results differ from it, not how accurate they are");
    requests.look_in(directory);
    try
      {
        compute_points();
      }
    catch (const StoppedOnRequest &request)
      {
        throw StoppedOnRequest(std::string(request.what()) +
                               " The points that are finished are kept: the "
                               "same command goes on with the others.");
      }

    log.line("  table in " + directory + "/sweep.md, sweep.csv, sweep.json");
    if (Utilities::MPI::broadcast(communicator, table->n_with_results(), 0) ==
        0)
      throw NumericalError("None of the points has results: " + directory +
                           "/sweep.md tells why.");
  }



  void
  ParameterSweep::compute_points()
  {
    if (needs_reference())
      table->set_reference(find_reference());

    for (std::size_t p = 0; p < scenes.points.size(); ++p)
      {
        const SweepFolder folder(directory + '/' + plan.points()[p].folder,
                                 scenes.points[p].used);
        if (const auto result = stored(scenes.points[p], folder))
          {
            conclude_point(p, *result, true);
            continue;
          }
        requests.stop_if_asked();
        log.progress("  " + numbered(p) + table->values(p) + " ...");
        SweepResult result = run_for_sweep(scenes.points[p].scene,
                                           folder,
                                           want_stress(quantities),
                                           for_failures,
                                           requests)
                               .result;
        collectively(communicator, [&]() {
          if (first_rank)
            {
              measure(scenes.points[p], folder, result);
              folder.finish(result);
            }
        });
        conclude_point(p, result, false);
      }
  }



  SweepResult
  ParameterSweep::find_reference()
  {
    const SweepFolder folder(directory + "/reference", scenes.reference.used);
    const auto        read_stress = [&](const SweepResult &of) {
      if (want_stress(quantities) && has_periods(of))
        reference_stress =
          std::make_unique<StressReader>(folder.file(SweepFolder::stress_file));
    };

    SweepResult result;
    bool        was_there = false;
    if (first_rank)
      try
        {
          const auto finished = folder.finished();
          was_there           = finished && finished->has_results();
          if (was_there)
            {
              read_stress(*finished);
              result = *finished;
            }
        }
      catch (const FileError &)
        {
          was_there = false; // damaged
        }
    was_there = Utilities::MPI::broadcast(communicator, was_there, 0);
    if (!was_there)
      {
        log.progress("  reference ...");
        const SweepRun run = run_for_sweep(scenes.reference.scene,
                                           folder,
                                           want_stress(quantities),
                                           for_failures,
                                           requests);
        if (run.exception != nullptr)
          throw_of_reference(run.exception);
        result = run.result;
        collectively(communicator, [&]() {
          if (first_rank)
            {
              read_stress(result);
              folder.finish(result);
            }
        });
      }
    log.line(std::string("  reference: ") +
             (was_there ? "already there" : "computed"));
    return result;
  }



  std::optional<SweepResult>
  ParameterSweep::stored(const SweepVariant &variant, const SweepFolder &folder)
  {
    std::optional<SweepResult> result;
    std::string                remark;
    if (first_rank)
      {
        result = folder.finished();
        if (result && result->has_results() && result->basis != basis())
          try
            {
              measure(variant, folder, *result);
              remark = "  errors of " + folder.path() + " measured anew";
            }
          catch (const FileError &error)
            {
              remark =
                std::string("  computed again, to measure errors anew: ") +
                error.what();
              result = std::nullopt;
            }
      }
    const bool there =
      Utilities::MPI::broadcast(communicator, result.has_value(), 0);
    collectively(communicator, [&]() {
      if (there && !remark.empty())
        folder.finish(*result);
    });
    if (!remark.empty())
      log.line(remark);
    if (there && !result)
      result = SweepResult(); // the other ranks need not know more
    return result;
  }



  void
  ParameterSweep::measure(const SweepVariant &variant,
                          const SweepFolder  &folder,
                          SweepResult        &result)
  {
    result.basis = basis();
    result.errors.clear();
    if (!result.has_results())
      return;
    const double   period   = variant.scene.loads.period;
    const Compared compared = marches_from_rest(variant.scene) &&
                                  marches_from_rest(scenes.reference.scene)
                                ? Compared::whole_run
                                : Compared::last_period;
    for (const Quantity &quantity : quantities)
      result.errors[quantity.name] = quantity.is_stress_field()
                                       ? stress_error(folder, result)
                                       : history_error(quantity,
                                                       folder.path(),
                                                       directory + "/reference",
                                                       period,
                                                       compared);
  }



  MeasuredError
  ParameterSweep::stress_error(const SweepFolder &folder,
                               const SweepResult &result) const
  {
    if (!has_periods(result))
      return MeasuredError::none("the run has computed no period");
    if (reference_stress == nullptr)
      return MeasuredError::none("the reference has computed no period");
    return StressReader(folder.file(SweepFolder::stress_file))
      .error(*reference_stress);
  }



  std::string
  ParameterSweep::numbered(const std::size_t number) const
  {
    return std::to_string(number + 1) + " of " +
           std::to_string(scenes.points.size()) + ": ";
  }



  void
  ParameterSweep::conclude_point(const std::size_t  number,
                                 const SweepResult &result,
                                 const bool         was_there)
  {
    std::string line;
    collectively(communicator, [&]() {
      if (!first_rank)
        return;
      table->add(result);
      table->write(directory);
      line = table->line(number);
    });
    log.line("  " + numbered(number) + line +
             (was_there ? " (already there)" : ""));
  }
} // namespace Crevasse
