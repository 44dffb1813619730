// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_chain_h
#define crevasse_parameters_chain_h

#include <string>
#include <vector>

namespace Crevasse
{
  /** A Maxwell body of a chain: its part of the stiffness, and the formula of
   * its relaxation time. */
  struct ChainBranch
  {
    double      fraction;
    std::string relaxation_time;
  };

  /** Reads "fraction: time; fraction: time".
   *
   * @throw SceneError that tells what is expected. */
  std::vector<ChainBranch>
  parse_chain(const std::string &text);
} // namespace Crevasse

#endif
