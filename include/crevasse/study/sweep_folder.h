// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_study_sweep_folder_h
#define crevasse_study_sweep_folder_h

#include <crevasse/base/summary.h>
#include <crevasse/study/sweep_result.h>

#include <optional>
#include <string>

namespace Crevasse
{
  /**
   * The results folder of one run of a sweep. `finished.json` is written last,
   * and is what an interrupted sweep goes by: it holds the result and the
   * sizes of all files, so that a damaged folder counts as unfinished.
   *
   * Nothing here communicates: the first rank alone looks after files.
   */
  class SweepFolder
  {
  public:
    /** The stress at all quadrature points, see StressReader. */
    static constexpr const char *stress_file = "stress_samples.bin";

    /** @param used_parameters of the run that belongs there. */
    SweepFolder(const std::string &path, const std::string &used_parameters);

    const std::string &
    path() const;

    std::string
    file(const std::string &name) const;

    /** The result of this very run, if it is there and undamaged. */
    std::optional<SweepResult>
    finished() const;

    /** Removes what is there, but keeps the results of another scene in a
     * folder of their own (clear_earlier_results()), and writes used.prm.
     * @throw FileError */
    void
    prepare() const;

    /** @throw FileError if it is not there or no JSON. */
    Summary
    summary() const;

    /** Declares the run finished. @throw FileError */
    void
    finish(const SweepResult &result) const;

  private:
    /** The sizes of the files that belong to the result. */
    Summary
    sizes() const;

    const std::string folder;
    const std::string used;
  };
} // namespace Crevasse

#endif
