// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

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
