// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/app/failure.h>
#include <crevasse/app/output_choice.h>
#include <crevasse/app/run_command.h>
#include <crevasse/base/collectively.h>
#include <crevasse/base/stop_request.h>
#include <crevasse/base/text_file.h>
#include <crevasse/base/version.h>
#include <crevasse/checkpoint/scene_difference.h>
#include <crevasse/parameters/scene_file.h>
#include <crevasse/simulation/adaptive_run.h>

#include <filesystem>

namespace Crevasse
{
  namespace
  {
    /** Prepares the output directory for the results of a new run. */
    std::unique_ptr<DirectoryLock>
    prepare(const OutputChoice &output, const std::string &used, Log &log)
    {
      std::string kept;
      auto        lock = output.prepare(kept);
      if (!kept.empty())
        log.line("  results of an earlier run are kept in " + kept);
      write_atomically(used, output.directory() + "/used.prm");
      return lock;
    }



    /** Prepares the output directory for the rest of a resumed run. */
    std::unique_ptr<DirectoryLock>
    resume(const OutputChoice &output,
           const std::string  &used,
           const Checkpoints  &checkpoints)
    {
      const CheckpointManifest &manifest = checkpoints.last_manifest();
      checkpoints.folder.require_tables(manifest);
      auto lock = output.resume();
      checkpoints.folder.go_back_to(manifest);
      write_atomically(used, output.directory() + "/used.prm");
      return lock;
    }



    /** Whether the run has finished, which is then logged. */
    bool
    has_finished(const OutputChoice &output,
                 const Scene        &scene,
                 const Summary      &parameters,
                 const MPI_Comm      communicator,
                 Log                &log)
    {
      std::string why;
      collectively(communicator, [&]() {
        if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
          why = output.why_finished(scene, parameters);
      });
      if (!why.empty())
        log.line("--resume: " + why);
      return dealii::Utilities::MPI::broadcast(communicator, !why.empty(), 0);
    }



    template <int dim>
    void
    run_scene(const Command     &command,
              const Scene       &scene,
              const std::string &used,
              const Summary     &parameters,
              StopRequests      &requests,
              Log               &log)
    {
      const MPI_Comm     communicator = MPI_COMM_WORLD;
      const OutputChoice output(command, scene);
      Checkpoints        checkpoints(requests,
                              log,
                              output.directory(),
                              parameters,
                              scene.output.checkpoint_every);
      if (command.resume)
        {
          if (has_finished(output, scene, parameters, communicator, log))
            return;
          checkpoints.resume(communicator);
        }
      else if (!command.check)
        collectively(communicator, [&]() {
          if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
            output.require_nothing_to_resume(used);
        });
      if (!command.check)
        requests.look_in(output.directory());
      AdaptiveRun<dim> run(scene, communicator, log, checkpoints);
      run.describe();
      if (command.check)
        {
          log.line("  output directory: " + output.directory());
          output.require_usable();
          log.line(scene.refinement.strategy == RefinementStrategy::adaptive
                     ? "The scene is in order; only elastic states were "
                       "computed, for the mesh."
                     : "The scene is in order; nothing was computed.");
          return;
        }

      const std::string             &directory = output.directory();
      std::unique_ptr<DirectoryLock> lock;
      collectively(communicator, [&]() {
        if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
          lock = command.resume ? resume(output, used, checkpoints)
                                : prepare(output, used, log);
      });
      log.open_file(directory + "/log.txt", command.resume);
      run.run();
      log.line("  results in " + directory);
      log.line("  to see them in a browser: crevasse report " + directory);
    }
  } // namespace



  Scene
  read_scene(const Command &command, dealii::ParameterHandler &prm)
  {
    if (std::error_code unknown;
        !std::filesystem::exists(command.scene_file, unknown))
      {
        const std::string guess = similar_to(command.scene_file);
        throw FileError("The file \"" + command.scene_file +
                        "\" does not exist" + (guess.empty() ? "." : guess));
      }
    Problems problems;
    Scene    scene =
      read_scene(command.scene_file, command.overrides, prm, problems);
    scene.check(problems);
    problems.throw_if_any();
    scene.output.stress_record = command.stress_record;
    if (command.stress_record && scene.refinement.readapt_every > 0)
      throw SceneError("[Refinement] Readapt every = " +
                       std::to_string(scene.refinement.readapt_every) +
                       ": stresses on changing meshes cannot be compared; set "
                       "it to 0, or leave stress out of the errors of the "
                       "sweep.");
    return scene;
  }



  int
  run_command(const Command &command)
  {
    // Failures have a communicator of their own.
    MPI_Comm for_failures;
    MPI_Comm_dup(MPI_COMM_WORLD, &for_failures);
    Log log(MPI_COMM_WORLD, command.quiet, command.verbose);
    int status = done;
    try
      {
        StopRequests             requests(MPI_COMM_WORLD, command.wall_time);
        dealii::ParameterHandler prm;
        const Scene              scene = read_scene(command, prm);
        log.line("Crevasse " CREVASSE_VERSION ": " +
                 std::filesystem::path(command.scene_file).filename().string());
        (scene.dimension == 2 ? run_scene<2>
                              : run_scene<3>)(command,
                                              scene,
                                              used_parameters(prm),
                                              scene_as_json(prm),
                                              requests,
                                              log);
      }
    catch (const StoppedOnRequest &request)
      {
        log.line(std::string("crevasse: ") + request.what());
        status = stopped;
      }
    catch (const std::exception &error)
      {
        status = report_failure(error, for_failures, log);
      }
    MPI_Comm_free(&for_failures);
    return status;
  }
} // namespace Crevasse
