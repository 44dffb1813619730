// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#include <crevasse/output/log.h>
#include <crevasse/run/adaptive_run.h>
#include <crevasse/run/command_line.h>
#include <crevasse/run/failure.h>
#include <crevasse/run/output_choice.h>
#include <crevasse/run/parameter_sweep.h>
#include <crevasse/run/version.h>
#include <crevasse/scene/collectively.h>
#include <crevasse/scene/problems.h>
#include <crevasse/scene/scene_file.h>

#include <deal.II/base/mpi.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>

namespace
{
  using namespace Crevasse;

  /** Makes the output directory ready for this run's results. */
  void
  prepare(const OutputChoice &output, const std::string &used, Log &log)
  {
    const std::string &directory = output.directory();
    const bool         replaces  = output.holds_other_results(used);
    output.prepare();
    if (replaces)
      log.line("  results of an earlier run in " + directory + " are replaced");

    const std::string file_name = directory + "/used.prm";
    std::ofstream     file(file_name);
    file << used << std::flush;
    if (!file)
      throw FileError("Cannot write " + file_name + ".");
  }



  template <int dim>
  void
  run_scene(const Command     &command,
            const Scene       &scene,
            const std::string &used,
            Log               &log)
  {
    const MPI_Comm   communicator = MPI_COMM_WORLD;
    AdaptiveRun<dim> run(scene, communicator, log);
    run.describe();
    const OutputChoice output(command, scene);
    if (command.check)
      {
        log.line("  output directory: " + output.directory());
        output.require_usable();
        log.line(scene.refinement.strategy == "adaptive"
                   ? "The scene is in order; nothing was computed but elastic "
                     "states, for the mesh."
                   : "The scene is in order; nothing was computed.");
        return;
      }

    const std::string &directory = output.directory();
    collectively(communicator, [&]() {
      if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
        prepare(output, used, log);
    });
    log.open_file(directory + "/log.txt");
    run.run(directory);
    log.line("  results in " + directory);
  }



  void
  read_and_run_scene(const Command &command, Log &log)
  {
    dealii::ParameterHandler prm;
    Problems                 problems;
    const Scene              scene =
      read_scene(command.scene_file, command.overrides, prm, problems);
    scene.check(problems);
    problems.throw_if_any();

    log.line("Crevasse " CREVASSE_VERSION ": " +
             std::filesystem::path(command.scene_file).filename().string());
    if (scene.dimension == 2)
      run_scene<2>(command, scene, used_parameters(prm), log);
    else
      run_scene<3>(command, scene, used_parameters(prm), log);
  }



  /** Runs, and turns every exception into a message and an exit status. */
  int
  run_guarded(const Command &command)
  {
    // Failures speak of themselves on a line of their own.
    MPI_Comm for_failures;
    MPI_Comm_dup(MPI_COMM_WORLD, &for_failures);
    Log log(MPI_COMM_WORLD, command.quiet);
    int status = done;
    try
      {
        if (command.sweep)
          ParameterSweep(command, for_failures, log).run();
        else if (command.print_format.empty())
          read_and_run_scene(command, log);
        else if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
          print_parameters(std::cout, command.print_format);
      }
    catch (const std::exception &error)
      {
        status = report_failure(error, for_failures, log);
      }
    MPI_Comm_free(&for_failures);
    return status;
  }
} // namespace



int
main(int argc, char **argv)
{
  const Command command = parse_command_line(argc, argv);
  if (command.exit)
    return command.status;

  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  return run_guarded(command);
}
