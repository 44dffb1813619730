// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_field_times_h
#define crevasse_parameters_field_times_h

#include <string>
#include <vector>

namespace Crevasse
{
  /** Instants of the last period at which fields are written, besides the end
   * of the run. */
  struct FieldTimes
  {
    bool                of_extremes = false; ///< extremes of opening, force, K
    bool                all         = false; ///< instants of all steps
    unsigned int        n_equal     = 0;     ///< number of equidistant instants
    std::vector<double> listed;

    /** Instants that are known before the run. */
    std::vector<double>
    instants(const double period) const;
  };

  /** Parses "automatic", "all", "12 instants" or "150, 300"; "" gives none.
   *
   * @throw SceneError that says what is expected. */
  FieldTimes
  parse_field_times(const std::string &text);
} // namespace Crevasse

#endif
