// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_app_server_h
#define crevasse_app_server_h

namespace Crevasse
{
  /** What main() does with a command line. */
  using Program = int (*)(int argc, char **argv);

  /**
   * `crevasse serve`: runs the program many times without starting it. Loading
   * 200 shared libraries takes 0.4 s, which is most of what a small scene
   * takes. This process has loaded them and forks before anything is
   * initialised, so that each run has a process of its own: an exit status,
   * signals, memory, and no state of others.
   *
   * A request is a line of standard input,
   *   {"id": 1, "arguments": ["a.prm"], "output": FILE, "error": FILE}
   * with the files for standard output and error; optional are "directory",
   * "seconds" after which the run is killed, and the variables of the
   * environment to "unset". Runs of several requests go on at the same time.
   * Lines of standard output tell of each run its process, to which signals may
   * be sent, and its end,
   *   {"id": 1, "process": 4711}
   *   {"id": 1, "status": 0, "cpu": 0.05}
   * where a status below zero is minus the number of the signal that ended it.
   * A request that cannot be read is answered with the id null and the
   * status 2. The end of the input ends all runs. Called before MPI starts.
   */
  int
  serve(const Program program);

  /** Makes such a server of a copy of this process, before another program
   * replaces it. The environment variable `CREVASSE_SERVER` tells that program
   * where to write requests and to read answers: "FILE DESCRIPTOR, FILE
   * DESCRIPTOR". */
  void
  leave_server(const Program program);
} // namespace Crevasse

#endif
