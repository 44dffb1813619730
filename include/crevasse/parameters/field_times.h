// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_field_times_h
#define crevasse_parameters_field_times_h

#include <string>
#include <vector>

namespace Crevasse
{
  /** The instants of the last period at which the fields are written, besides
   * the end of the run. */
  struct FieldTimes
  {
    bool                of_extremes = false; ///< of opening, force, K
    bool                all         = false; ///< all steps
    unsigned int        n_equal     = 0;     ///< so many at equal distances
    std::vector<double> listed;

    /** Those that are known in advance. */
    std::vector<double>
    instants(const double period) const;
  };

  /** Reads "automatic", "all", "12 instants" or "150, 300"; nothing gives none.
   *
   * @throw SceneError that says what is expected. */
  FieldTimes
  parse_field_times(const std::string &text);
} // namespace Crevasse

#endif
