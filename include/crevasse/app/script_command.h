// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_app_script_command_h
#define crevasse_app_script_command_h

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
} // namespace Crevasse

#endif
