// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_environment_h
#define crevasse_base_environment_h

#include <crevasse/base/summary.h>

#include <string>
#include <vector>

namespace Crevasse
{
  /** Names and versions of the numerical libraries. */
  std::map<std::string, std::string>
  library_versions();

  /** What else a measured time depends on: date and time (UTC), processor,
   * compiler, BLAS, numbers of processes and of threads of each, and the
   * command line. */
  Summary
  environment(const std::vector<std::string> &command_line);

  /** The text of --version: the version alone in the first line. */
  std::string
  version_text();
} // namespace Crevasse

#endif
