// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_study_advise_report_h
#define crevasse_study_advise_report_h

#include <crevasse/study/advise_pairs.h>
#include <crevasse/study/sweep_scenes.h>

#include <optional>
#include <string>
#include <vector>

namespace Crevasse
{
  /** What an advice has found: advised.prm, advice.md, advice.json, and some
   * words for the terminal. Nothing here communicates. */
  class AdviseReport
  {
  public:
    /** All of them must outlive this. */
    AdviseReport(const std::string  &scene_file,
                 const double        target,
                 const bool          reached,
                 const AdvisePairs  &pairs,
                 const AdviseSearch &space,
                 const AdviseSearch &time,
                 const AdviseRuns   &runs);

    /** On the first rank. @throw FileError */
    void
    write(const std::string &directory) const;

    std::vector<std::string>
    conclusion(const std::string &directory) const;

    /** Two significant digits. */
    static std::string
    short_number(const double number);

    std::string choice; ///< in words
    /** Of the choice against its reference, for each quantity; empty if there
     * is no reference. */
    std::vector<double> errors;
    const SweepVariant *original = nullptr;
    const SweepVariant *advised  = nullptr;
    /** The scene with its own settings, once it has been run. */
    const AdviseRun      *run_as_it_was = nullptr;
    std::optional<double> error_as_it_was;

  private:
    /** "[Section] Name", what it was and what it is. */
    struct Change
    {
      std::string parameter, before, now;
    };

    std::vector<Change>
    changes() const;

    std::string
    measured() const;
    std::string
    scene() const;
    std::string
    markdown() const;
    std::string
    table_of_quantities() const;
    std::string
    table_of_finalists() const;
    std::string
    table_of_points(const AdviseSearch &search) const;
    std::string
    notes() const;
    Summary
    json() const;
    Summary
    json_of_points(const AdviseSearch &search) const;

    const std::string   scene_file;
    const double        target;
    const bool          reached;
    const AdvisePairs  &pairs;
    const AdviseSearch &space, &time;
    const AdviseRuns   &runs;
  };
} // namespace Crevasse

#endif
