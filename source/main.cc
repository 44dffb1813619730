// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/app/failure.h>
#include <crevasse/app/output_choice.h>
#include <crevasse/app/script_command.h>
#include <crevasse/base/collectively.h>
#include <crevasse/base/expression.h>
#include <crevasse/base/single_process.h>
#include <crevasse/base/stop_request.h>
#include <crevasse/base/text.h>
#include <crevasse/base/text_file.h>
#include <crevasse/base/version.h>
#include <crevasse/checkpoint/scene_difference.h>
#include <crevasse/parameters/scene_file.h>
#include <crevasse/simulation/adaptive_run.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>
#include <iostream>

namespace
{
  using namespace Crevasse;

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
    if (command.stress_record && scene.refinement.readapt_every > 0)
      throw SceneError(
        "[Refinement] Readapt every = " +
        std::to_string(scene.refinement.readapt_every) +
        ": stresses on changing meshes cannot be compared; set it to 0, or "
        "leave stress out of the errors of the sweep.");
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
    run.run(directory, command.stress_record);
    log.line("  results in " + directory);
    log.line("  to see them in a browser: crevasse report " + directory);
  }



  /** Reads a scene. @throw SceneError with all mistakes; FileError */
  Scene
  read_and_check(const Command &command, dealii::ParameterHandler &prm)
  {
    if (std::error_code unknown;
        !std::filesystem::exists(command.scene_file, unknown))
      {
        const std::string guess = similar_to(command.scene_file);
        throw FileError("The file \"" + command.scene_file +
                        "\" does not exist" + (guess.empty() ? "." : guess));
      }
    Problems    problems;
    const Scene scene =
      read_scene(command.scene_file, command.overrides, prm, problems);
    scene.check(problems);
    problems.throw_if_any();
    return scene;
  }



  void
  read_and_run_scene(const Command &command, StopRequests &requests, Log &log)
  {
    dealii::ParameterHandler prm;
    const Scene              scene = read_and_check(command, prm);
    log.line("Crevasse " CREVASSE_VERSION ": " +
             std::filesystem::path(command.scene_file).filename().string());
    const auto run = scene.dimension == 2 ? run_scene<2> : run_scene<3>;
    run(
      command, scene, used_parameters(prm), scene_as_json(prm), requests, log);
  }



  /** Prints the parameters of the scene, or else the defaults. */
  void
  print_parameters_of(const Command &command)
  {
    std::ostringstream text;
    if (command.scene_file.empty())
      print_parameters(text, command.print_format);
    else if (command.print_format != "prm" && command.print_format != "json")
      throw SceneError("--print-parameters " + command.print_format +
                       " describes all parameters; for the values of a scene "
                       "use prm or json.");
    else
      {
        dealii::ParameterHandler prm;
        const Scene              scene = read_and_check(command, prm);
        Summary                  json  = scene_as_json(prm);
        json.erase(checksums_of_files);
        text << (command.print_format == "prm" ? used_parameters(prm)
                                               : json.dump(2) + '\n');
      }
    std::cout << text.str() << std::flush;
    if (!std::cout)
      throw FileError("Cannot write to the standard output.");
  }



  /** Prints parameters without MPI, whose start would take longer: a sweep asks
   * for each point. With mpirun only the first process answers. */
  int
  show_parameters(const Command &command)
  {
    const char *rank = std::getenv("OMPI_COMM_WORLD_RANK");
    if (rank != nullptr && std::string(rank) != "0")
      return done;
    try
      {
        print_parameters_of(command);
        return done;
      }
    catch (const std::exception &error)
      {
        std::cerr << "crevasse: " << error.what() << std::endl;
        return exit_status_of(error);
      }
  }



  /** `crevasse evaluate NAME FORMULA T...`: prints the values of a closed form,
   * a line each, to the Python package. */
  int
  evaluate(const int argc, char **argv)
  {
    try
      {
        const Expression formula(argv[3],
                                 Expression::Variables::space_and_time,
                                 argv[2]);
        if (formula.depends_on_space())
          throw SceneError("a formula may depend on t, but not on x, y, z");
        for (int i = 4; i < argc; ++i)
          std::cout << Text::from_number(
                         formula.value(dealii::Point<2>(), std::stod(argv[i])))
                    << '\n';
        return done;
      }
    catch (const std::exception &error) // also if T is no number
      {
        std::cerr << error.what() << std::endl;
        return bad_input;
      }
  }



  /** Runs a command, and turns exceptions into messages and exit statuses. */
  int
  run_guarded(const Command &command)
  {
    // Failures have a communicator of their own.
    MPI_Comm for_failures;
    MPI_Comm_dup(MPI_COMM_WORLD, &for_failures);
    Log log(MPI_COMM_WORLD, command.quiet, command.verbose);
    int status = done;
    try
      {
        StopRequests requests(MPI_COMM_WORLD, command.wall_time);
        read_and_run_scene(command, requests, log);
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



  /** Signals of signals_to_stop that the program ignores from its start: nohup
   * ignores SIGHUP, and shells SIGINT for background processes. */
  std::vector<int>
  ignored_signals()
  {
    std::vector<int> ignored;
    for (const int signal : signals_to_stop)
      if (struct sigaction action = {};
          sigaction(signal, nullptr, &action) == 0 &&
          action.sa_handler == SIG_IGN)
        ignored.push_back(signal);
    return ignored;
  }



  /** Executes a command line and returns the exit status. */
  int
  run_program(int argc, char **argv)
  {
    const std::string word = argc > 1 ? argv[1] : "";
    if (is_script_command(argc, argv))
      return run_script_command(argc, argv, run_program);
    if (word == "serve")
      return serve(run_program);
    if (word == "evaluate" && argc > 3)
      return evaluate(argc, argv);
    const std::vector<int> ignored = ignored_signals();
    // A request for a checkpoint before the run can write one must not end the
    // program.
    std::signal(SIGUSR1, SIG_IGN);
    const Command command = parse_command_line(argc, argv);
    if (command.exit)
      return command.status;
    if (!command.print_format.empty())
      return show_parameters(command);

    set_up_single_process();
    // PETSc, if deal.II starts it, would take options for its own and report
    // unused ones: it gets only the name of the program.
    int                                      only_name = 1;
    dealii::Utilities::MPI::MPI_InitFinalize mpi(only_name, argv, 1);
    // The reader of the log may end before the run; Open MPI handles SIGPIPE in
    // another way.
    std::signal(SIGPIPE, SIG_IGN);
    for (const int signal : ignored) // MPI may have set them
      std::signal(signal, SIG_IGN);
    return run_guarded(command);
  }
} // namespace



int
main(int argc, char **argv)
{
  return run_program(argc, argv);
}
