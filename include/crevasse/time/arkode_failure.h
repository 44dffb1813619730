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

#ifndef crevasse_time_arkode_failure_h
#define crevasse_time_arkode_failure_h

#include <string>

namespace Crevasse
{
  /**
   * What happened when ARKODE returned the negative @p code at the instant
   * @p t, and which parameter to change.
   *
   * @param words what ARKODE itself says.
   */
  std::string
  describe_arkode_failure(const int          code,
                          const double       t,
                          const std::string &words);
} // namespace Crevasse

#endif
