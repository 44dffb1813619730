// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_app_script_command_h
#define crevasse_app_script_command_h

#include <crevasse/app/command_line.h>
#include <crevasse/app/server.h>

#include <string>
#include <vector>

namespace Crevasse
{
  /** A subcommand that runs a script of the Python package. */
  struct ScriptCommand
  {
    std::string name, meaning;
  };

  const std::vector<ScriptCommand> &
  script_commands();

  /** Whether the first argument of the program is a script command.
   * @param words the name of the program and its arguments. */
  bool
  is_script_command(const std::vector<std::string> &words);

  /**
   * Replaces this process, before MPI starts, by `CREVASSE_PYTHON -m crevasse
   * NAME ...`. The package is searched beside the program: in `python` of a
   * build directory, or in `../share/crevasse/python` of an installation. The
   * environment variable `CREVASSE_PROGRAM` is the path of the program; a
   * server executes its runs, see leave_server().
   *
   * @return the exit status if that is impossible, after a message.
   */
  int
  run_script_command(const std::vector<std::string> &words);

  /**
   * Replaces this process, after its run and the end of MPI, by the script that
   * adds error bars to the results; with mpirun on the first process.
   *
   * @param seconds left of --wall-time, if there is one.
   * @return the exit status if that is impossible, after a message.
   */
  int
  add_bars(const Command        &command,
           const std::string    &directory,
           std::optional<double> seconds);

  /**
   * Replaces this process, before MPI starts, by the script that repeats the
   * scene until its results have Command::accuracy; with mpirun each process.
   *
   * @return the exit status if that is impossible, after a message.
   */
  int
  repeat_until_accurate(const Command &command);

  /** Runs a script command in a child process.
   *
   * @param words as those of run_script_command().
   * @param input for its standard input.
   * @return its exit status, or file_failure if there is no child. */
  int
  wait_for_script(const std::vector<std::string> &words,
                  const bool                      quiet,
                  const std::string              &input = "");

  /**
   * Converts the mesh file of a scene by `crevasse mesh`, before MPI starts, if
   * it is one of another program and not yet converted. A process of mpirun
   * does not convert; reading the scene reports it.
   *
   * @return an exit status other than done if that fails, after a message.
   */
  int
  convert_mesh(const Command &command);
} // namespace Crevasse

#endif
