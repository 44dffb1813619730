// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_app_failure_h
#define crevasse_app_failure_h

#include <crevasse/base/log.h>

#include <exception>

namespace Crevasse
{
  /** Of the program that ends by this exception: 2 for SceneError, 4 for
   * FileError, 3 for the rest. */
  int
  exit_status_of(const std::exception &error);

  /**
   * The end of a run by an exception: writes its message and returns its exit
   * status.
   *
   * Most errors are thrown on all ranks at once. If this rank alone has one, as
   * when the first one cannot write a table, the others wait for it in some
   * communication for ever: after some seconds it ends all of them by
   * MPI_Abort, with the same status.
   */
  int
  report_failure(const std::exception &error,
                 const MPI_Comm        communicator,
                 Log                  &log);
} // namespace Crevasse

#endif
