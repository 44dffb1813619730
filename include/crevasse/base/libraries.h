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
