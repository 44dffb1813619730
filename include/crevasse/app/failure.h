// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_app_failure_h
#define crevasse_app_failure_h

#include <crevasse/base/log.h>

#include <exception>

namespace Crevasse
{
  /** Exit status of the program for an exception: 2 for SceneError, 4 for
   * FileError, 3 for others. */
  int
  exit_status_of(const std::exception &error);

  /**
   * Ends a run by an exception: writes its message and returns its exit status.
   *
   * Most errors are thrown on all ranks at once. If only one rank has an error,
   * e.g. if the first rank cannot write a table, the others would wait for it
   * forever: after some seconds the rank ends all ranks by MPI_Abort, with the
   * same status.
   */
  int
  report_failure(const std::exception &error,
                 const MPI_Comm        communicator,
                 Log                  &log);
} // namespace Crevasse

#endif
