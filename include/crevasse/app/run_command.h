// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_app_run_command_h
#define crevasse_app_run_command_h

#include <crevasse/app/command_line.h>
#include <crevasse/parameters/scene.h>

namespace Crevasse
{
  /** Reads the scene of a command.
   * @throw SceneError with all mistakes; FileError */
  Scene
  read_scene(const Command &command, dealii::ParameterHandler &prm);

  /** Exit status of the program for an exception: 2 for SceneError, 4 for
   * FileError, 3 for others. */
  int
  exit_status_of(const std::exception &error);

  /** Runs, resumes or checks the scene of a command, and turns exceptions into
   * messages. Collective.
   * @return the exit status. */
  int
  run_command(const Command &command);
} // namespace Crevasse

#endif
