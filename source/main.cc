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
#include <crevasse/output/output_directory.h>
#include <crevasse/run/command_line.h>
#include <crevasse/run/simulation.h>
#include <crevasse/run/version.h>
#include <crevasse/scene/problems.h>
#include <crevasse/scene/scene_file.h>

#include <deal.II/base/mpi.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>

namespace
{
  using namespace Crevasse;

  std::string
  output_directory(const Command &command, const Scene &scene)
  {
    if (!command.output_directory.empty())
      return command.output_directory;
    if (!scene.output_directory.empty())
      return scene.output_directory;
    return "results/" +
           std::filesystem::path(command.scene_file).stem().string();
  }



  void
  write_used_parameters(dealii::ParameterHandler &prm,
                        const std::string        &file_name)
  {
    std::ostringstream text;
    prm.print_parameters(text, dealii::ParameterHandler::PRM);
    std::ofstream file(file_name);
    file << text.str() << std::flush;
    if (!file)
      throw FileError("Cannot write " + file_name + ".");
  }



  void
  run_scene(const Command &command)
  {
    const MPI_Comm communicator = MPI_COMM_WORLD;
    dealii::ParameterHandler prm;
    Problems                 problems;
    const Scene              scene =
      read_scene(command.scene_file, command.overrides, prm, problems);
    scene.check(problems);
    problems.throw_if_any();

    Log log(communicator, command.quiet);
    log.line("Crevasse " CREVASSE_VERSION ": " +
             std::filesystem::path(command.scene_file).filename().string());
    Simulation<2> simulation(scene, communicator, log);
    simulation.describe();
    if (command.check)
      {
        log.line("The scene is in order; nothing was computed.");
        return;
      }

    const std::string directory = output_directory(command, scene);
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      {
        require_writable_directory(directory);
        remove_earlier_results(directory);
        write_used_parameters(prm, directory + "/used.prm");
      }
    log.open_file(directory + "/log.txt");
    simulation.run(directory);
    log.line("  results in " + directory);
  }



  /** Runs, and turns every exception into a message and an exit status. */
  int
  run_guarded(const Command &command)
  {
    const auto report = [](const std::exception &error, const int status) {
      if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        std::cerr << "crevasse: " << error.what() << std::endl;
      return status;
    };
    try
      {
        if (!command.print_format.empty())
          print_parameters(std::cout, command.print_format);
        else
          run_scene(command);
        return done;
      }
    catch (const SceneError &error)
      {
        return report(error, bad_input);
      }
    catch (const FileError &error)
      {
        return report(error, file_failure);
      }
    catch (const std::exception &error)
      {
        return report(error, numerical_failure);
      }
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
