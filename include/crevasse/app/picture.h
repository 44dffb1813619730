// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_app_picture_h
#define crevasse_app_picture_h

#include <crevasse/app/command_line.h>
#include <crevasse/base/log.h>
#include <crevasse/base/summary.h>

namespace Crevasse
{
  /** Checks that the page of --picture, if any, can be made: by one process,
   * and in the place of nothing but another such page.
   * @throw SceneError or FileError */
  void
  require_place_of_picture(const Command &command, const MPI_Comm communicator);

  /** Makes the page of --picture by the Python package.
   * @param picture mesh_picture(), to which the log and more is added.
   * @throw FileError */
  void
  draw_picture(const Command &command, Summary picture, Log &log);
} // namespace Crevasse

#endif
