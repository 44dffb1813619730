// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_libraries_h
#define crevasse_base_libraries_h

#include <map>
#include <string>

namespace Crevasse
{
  /** The libraries that compute, with their versions. */
  std::map<std::string, std::string>
  library_versions();
} // namespace Crevasse

#endif
