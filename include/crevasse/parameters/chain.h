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
