// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/app/picture.h>
#include <crevasse/app/script_command.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text_file.h>

#include <filesystem>

namespace Crevasse
{
  void
  require_place_of_picture(const Command &command, const MPI_Comm communicator)
  {
    if (command.picture.empty())
      return;
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) > 1)
      throw SceneError(
        "--picture needs the whole mesh on one process: run "
        "crevasse --check without mpirun.");
    std::error_code   unknown;
    const std::string sign =
      "<meta name=\"generator\" content=\"crevasse "
      "--picture\">"; // of templates/picture.html
    // A pipe would be read forever.
    if (std::filesystem::exists(command.picture, unknown) &&
        (!std::filesystem::is_regular_file(command.picture, unknown) ||
         read_text_file(command.picture).find(sign) == std::string::npos))
      throw FileError(
        command.picture +
        " is not a page of --picture, and is not replaced. Choose "
        "another name, or move the file away.");
  }



  void
  draw_picture(const Command &command, Summary picture, Log &log)
  {
    picture["scene"] = command.scene_file;
    picture["log"]   = log.lines();
    // Names need not be UTF-8.
    if (wait_for_script(
          {"crevasse", "picture", command.picture},
          command.quiet,
          picture.dump(-1, ' ', false, Summary::error_handler_t::replace)) !=
        done)
      throw FileError("The picture " + command.picture + " was not made.");
    log.line("  picture: " + command.picture);
  }
} // namespace Crevasse
