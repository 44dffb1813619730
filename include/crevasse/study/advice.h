// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_study_advice_h
#define crevasse_study_advice_h

#include <crevasse/app/command_line.h>
#include <crevasse/base/log.h>
#include <crevasse/base/stop_request.h>
#include <crevasse/study/advise_pairs.h>
#include <crevasse/study/advise_period.h>
#include <crevasse/study/advise_runs.h>
#include <crevasse/study/advise_search.h>
#include <crevasse/study/sweep_scenes.h>

#include <optional>
#include <string>
#include <vector>

namespace Crevasse
{
  /**
   * `crevasse advise`: finds the cheapest settings with which a scene reaches
   * an error in the histories of its probes, or of other quantities, and writes
   * them as a scene.
   *
   * Errors in time and in space are searched one after the other, the first on
   * a coarse mesh, the second with few steps, and put together by AdvisePairs.
   */
  class Advice
  {
  public:
    /** Reads the scene. @throw SceneError with all that is wrong with it, also
     * if it has no probes.
     *
     * @param for_failures a communicator that nothing else uses. */
    Advice(const Command &command,
           const MPI_Comm for_failures,
           StopRequests  &requests,
           Log           &log);

    /** @throw FileError; StoppedOnRequest; NumericalError if the error is not
     * reached, after the files were written. */
    void
    run();

  private:
    /** Everything but the original settings. */
    AdvisePairs
    find();

    /** The first of a family's meshes on which the scene is not refused, with
     * steps that are stable whatever their length. */
    const AdviseCandidate &
    coarsest_mesh(const AdviseFamily &meshes, const AdviseFamily &stable_steps);

    /** The point in time that candidates in space are run with. */
    std::size_t
    base_in_time() const;

    const AdviseRun &
    run_pair(const AdviseCandidate      &in_space,
             const AdviseCandidate      &in_time,
             const AdvisePeriod::Purpose purpose);

    /** What the advised scene sets. */
    std::vector<Override>
    settings(const AdviseCandidate      &in_space,
             const AdviseCandidate      &in_time,
             const AdvisePeriod::Purpose purpose) const;

    /** Writes what was found, and tells it. */
    void
    report(const AdvisePairs &pairs, const bool reached);

    const Command               command;
    const MPI_Comm              communicator;
    const bool                  first_rank;
    StopRequests               &requests;
    Log                        &log;
    const SweepVariant          original;
    const std::string           directory;
    const std::vector<Override> common;
    AdviseRuns                  runs;
    AdvisePeriod                period;
    std::optional<AdviseSearch> in_time, in_space;
  };
} // namespace Crevasse

#endif
