// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

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
