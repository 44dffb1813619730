// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_app_command_line_mistake_h
#define crevasse_app_command_line_mistake_h

#include <CLI/App.hpp>

namespace Crevasse
{
  /** Prints help or version if these were asked for; else what was wrong with
   * the command line, and what may have been meant.
   * @return 0 if nothing was wrong */
  int
  tell(const CLI::ParseError &error, const CLI::App &app);
} // namespace Crevasse

#endif
