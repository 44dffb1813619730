// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

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
