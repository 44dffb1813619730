// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_study_sweep_result_h
#define crevasse_study_sweep_result_h

#include <crevasse/base/summary.h>
#include <crevasse/study/measured_error.h>

#include <map>
#include <string>

namespace Crevasse
{
  /** What came of one point of a sweep. */
  struct SweepResult
  {
    /** "done", "not converged" (all results are there, but the stress is not
     * periodic), "refused" before computing, or "failed". */
    std::string status;
    /** Of what refused or failed. */
    std::string message;
    /** By the names of their quantities. */
    std::map<std::string, MeasuredError> errors;
    /** What errors were measured against; if it changes, so do they. */
    std::string basis;
    /** Counters and seconds by their names in the table. */
    Summary costs;

    bool
    has_results() const;

    Summary
    to_json() const;

    /** @throw nlohmann::json::exception if something is missing. */
    static SweepResult
    from_json(const Summary &json);
  };

  /** The costs in the summary of a run, in the order of the table's columns;
   * what a summary lacks is left out. */
  Summary
  costs_in(const Summary &summary);

  /** The names of all costs. */
  const std::vector<std::string> &
  cost_names();
} // namespace Crevasse

#endif
