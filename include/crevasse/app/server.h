// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_app_server_h
#define crevasse_app_server_h

#include <optional>
#include <string>
#include <vector>

namespace Crevasse
{
  /**
   * `crevasse serve`: runs the program many times without starting it. Loading
   * 200 shared libraries takes 0.4 s, most of the time of a small scene. The
   * server has loaded them and forks before anything is initialised, so that
   * each run has its own process: exit status, signals, memory, and no state of
   * other runs.
   *
   * A request is a line of standard input,
   *
   *     {"id": 1, "arguments": ["a.prm"], "output": FILE, "error": FILE}
   *
   * with the files for standard output and error; optional are "directory",
   * "seconds" after which the run is killed, and the variables of the
   * environment to "unset". Several requests run at the same time. For each
   * run, lines of standard output report its process, to which signals may be
   * sent, and its end,
   *
   *     {"id": 1, "process": 4711}
   *     {"id": 1, "status": 0, "cpu": 0.05}
   *
   * where a negative status is minus the number of the signal that ended the
   * run. A request that cannot be read is answered with the id null and the
   * status 2. The end of the input ends all runs. Called before MPI starts.
   *
   * @return in the process of a run, the name of the program and its arguments;
   * the server itself does not return.
   */
  std::vector<std::string>
  serve();

  /** Starts a server in a copy of this process, before another program replaces
   * the process. The environment variable `CREVASSE_SERVER` gives that program
   * the descriptors to write requests and read answers: "FILE DESCRIPTOR, FILE
   * DESCRIPTOR".
   *
   * @return in the process of a run, as serve(); nothing in this process. */
  std::optional<std::vector<std::string>>
  leave_server();
} // namespace Crevasse

#endif
