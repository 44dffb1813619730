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

#ifndef crevasse_parameters_recorded_steps_h
#define crevasse_parameters_recorded_steps_h

#include <set>
#include <string>
#include <utility>

namespace Crevasse
{
  /** Steps of a run by their period, counted from 1, and their number in it,
   * counted from 0. */
  using RecordedSteps = std::set<std::pair<unsigned int, unsigned int>>;

  /** Reads "period: step; period: step"; nothing gives none.
   *
   * @throw SceneError that tells what is expected. */
  RecordedSteps
  parse_recorded_steps(const std::string &text);
} // namespace Crevasse

#endif
