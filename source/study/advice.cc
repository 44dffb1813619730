// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/base/version.h>
#include <crevasse/study/advice.h>
#include <crevasse/study/advise_report.h>

#include <filesystem>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    // Steps with which candidates in space are compared.
    constexpr double error_of_base = 0.1;



    /** What is chosen automatically, and what has no use beside that or counts
     * steps. */
    std::vector<Override>
    common_settings(const Scene &scene)
    {
      std::vector<Override> settings = {advised("Contact/Solver=automatic"),
                                        advised(
                                          "Linear solver/Type=automatic")};
      if (!scene.contact.relaxation_table.empty())
        settings.push_back(advised("Contact/Relaxation table="));
      return settings;
    }
  } // namespace



  Advice::Advice(const Command &command,
                 const MPI_Comm for_failures,
                 StopRequests  &requests,
                 Log           &log)
    : command(command)
    , communicator(MPI_COMM_WORLD)
    , first_rank(Utilities::MPI::this_mpi_process(communicator) == 0)
    , requests(requests)
    , log(log)
    , original(read_variant(command.scene_file, command.overrides))
    , directory(directory_of_study(command, original.scene, "_advice"))
    , common(common_settings(original.scene))
    , runs(command, original.scene, directory, for_failures, requests, log)
    , period(original.scene, command.target_error)
  {
  }



  void
  Advice::run()
  {
    const auto lock = take_study_directory(directory, communicator);
    log.open_file(directory + "/advice.log");
    log.line("Crevasse " CREVASSE_VERSION ": settings of " +
             std::filesystem::path(command.scene_file).filename().string() +
             " for an error of " + Text::from_number(command.target_error));
    log.line(runs.periodic()
               ? "  compared is the periodic state: the last period, "
                 "displacements less their mean values"
               : "  compared are all instants from rest");
    requests.look_in(directory);
    try
      {
        AdvisePairs pairs   = find();
        const bool  reached = pairs.find();
        report(pairs, reached);
      }
    catch (const StoppedOnRequest &request)
      {
        throw StoppedOnRequest(std::string(request.what()) +
                               " The runs that are finished are kept: the "
                               "same command goes on with the others.");
      }
  }



  AdvisePairs
  Advice::find()
  {
    using Purpose                = AdvisePeriod::Purpose;
    const auto            time   = families_in_time(original.scene);
    const auto            meshes = families_in_space(original.scene);
    const AdviseCandidate coarsest =
      coarsest_mesh(meshes.front(), family_of("sdirk2", time));
    period.choose(time, coarsest, common, runs, log);

    log.line("Time, on a coarse mesh:");
    in_time.emplace(
      AdviseSearch::Part::time,
      time,
      [this, coarsest](const AdviseCandidate &candidate) -> const AdviseRun & {
        return run_pair(coarsest, candidate, Purpose::search);
      },
      runs,
      log);
    in_time->extend_to(AdvisePairs::part_in_time * command.target_error);
    if (in_time->points().empty())
      throw NumericalError(
        "advise: nothing could be run on the coarsest mesh: " +
        Text::join(in_time->notes(), "; "));
    runs.require_histories(*in_time->points().front().run);

    const std::size_t     base  = base_in_time();
    const AdviseCandidate steps = in_time->points()[base].candidate;
    log.line("Space, with " + steps.text + ":");
    in_space.emplace(
      AdviseSearch::Part::space,
      meshes,
      [this, steps](const AdviseCandidate &candidate) -> const AdviseRun & {
        return run_pair(candidate, steps, Purpose::search);
      },
      runs,
      log);
    in_space->extend_to(AdvisePairs::part_in_space * command.target_error);
    if (runs.n_that_count() == 0)
      throw NumericalError(
        "advise: no history that is compared converges as the cells are "
        "halved, so that there is no error that could be reached: " +
        Text::join(in_space->notes(), "; "));

    log.line("Both together:");
    return AdvisePairs(
      *in_space,
      *in_time,
      base,
      command.target_error,
      period.times_those_of_a_search(),
      [this](const AdviseCandidate &space,
             const AdviseCandidate &time,
             const Purpose          purpose) -> const AdviseRun & {
        return run_pair(space, time, purpose);
      },
      runs);
  }



  const AdviseCandidate &
  Advice::coarsest_mesh(const AdviseFamily &meshes,
                        const AdviseFamily &stable_steps)
  {
    const AdviseCandidate &steps = stable_steps.candidates.front();
    for (unsigned int k = 0; k <= meshes.refusals_that_pass; ++k)
      {
        const AdviseCandidate &mesh = meshes.candidates[k];
        const AdviseRun       &trial =
          runs.run(mesh.name + "__" + steps.name + "__one_period",
                   joined({common,
                           mesh.settings,
                           steps.settings,
                           {advised("Periodic state/Method=march"),
                            advised("Periodic state/Start from=rest"),
                            advised("Periodic state/Tolerance=0"),
                            advised("Periodic state/Maximum periods=1")}}));
        // What is not written is told before much is computed.
        if (trial.usable())
          runs.require_histories(trial);
        if (trial.result.status != "refused")
          return mesh;
      }
    return meshes.candidates.front();
  }



  std::size_t
  Advice::base_in_time() const
  {
    // The least work, but such that its errors are small beside what happens.
    const std::vector<AdvisePoint> &points = in_time->points();
    std::size_t                     best   = in_time->reference();
    for (std::size_t p = 0; p < points.size(); ++p)
      if (points[p].error < error_of_base &&
          points[p].run->work() < points[best].run->work())
        best = p;
    return best;
  }



  std::vector<Override>
  Advice::settings(const AdviseCandidate      &in_space,
                   const AdviseCandidate      &in_time,
                   const AdvisePeriod::Purpose purpose) const
  {
    return joined({common,
                   in_space.settings,
                   in_time.settings,
                   period.settings(in_time, purpose)});
  }



  const AdviseRun &
  Advice::run_pair(const AdviseCandidate      &in_space,
                   const AdviseCandidate      &in_time,
                   const AdvisePeriod::Purpose purpose)
  {
    return runs.run(in_space.name + "__" + in_time.name +
                      period.name(in_time, purpose),
                    settings(in_space, in_time, purpose));
  }



  void
  Advice::report(const AdvisePairs &pairs, const bool reached)
  {
    const AdviseFinalist  &best = pairs.best();
    const AdviseCandidate &space =
                            in_space->points()[best.pair.space].candidate,
                          &time = in_time->points()[best.pair.time].candidate;
    const SweepVariant advised_scene =
      read_variant(command.scene_file,
                   joined({command.overrides,
                           settings(space, time, AdvisePeriod::Purpose::result),
                           {advised("Output directory=")}}));

    AdviseReport report(command.scene_file,
                        command.target_error,
                        reached,
                        pairs,
                        *in_space,
                        *in_time,
                        runs);
    report.choice   = space.text + "; " + time.text + "; " + period.text(time);
    report.original = &original;
    if (best.reference != nullptr)
      report.errors = runs.differences(*best.run, *best.reference);
    report.advised = &advised_scene;
    collectively(communicator, [&]() {
      if (first_rank)
        report.write(directory);
    });
    // Last: it may take longer than all else, and the advice is there already.
    const AdviseRun &as_it_was = runs.run("original", {});
    report.run_as_it_was       = &as_it_was;
    if (as_it_was.result.has_results() && best.reference != nullptr)
      report.error_as_it_was = runs.difference(as_it_was, *best.reference);
    collectively(communicator, [&]() {
      if (first_rank)
        report.write(directory);
    });
    for (const std::string &line : report.conclusion(directory))
      log.line(line);
    if (!reached)
      throw NumericalError(
        "advise: the error is not reached: the settings that come nearest have "
        "an error of " +
        AdviseReport::short_number(best.error) + ". " + directory +
        "/advice.md tells how far each kind of mesh and scheme was taken.");
  }
} // namespace Crevasse
