// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_study_advise_runs_h
#define crevasse_study_advise_runs_h

#include <crevasse/app/command_line.h>
#include <crevasse/base/log.h>
#include <crevasse/base/stop_request.h>
#include <crevasse/study/history.h>
#include <crevasse/study/quantity.h>
#include <crevasse/study/sweep_result.h>
#include <crevasse/study/sweep_scenes.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace Crevasse
{
  /** One run of an advice; all ranks know the same of it. */
  struct AdviseRun
  {
    std::string           name; ///< its folder
    std::vector<Override> settings;
    SweepResult           result;

    /** Whether its histories are what was asked for. */
    bool
    usable() const;

    /** Of the processor, with the set-up of meshes: other work on the machine
     * does not count. */
    double
    seconds() const;

    /** Solves, evaluations and factorisations in units of one solve: what
     * steps cost beside other steps on the same mesh. Seconds of runs on coarse
     * meshes are mostly set-up and noise. */
    double
    work() const;

    double
    cost(const std::string &name) const;
  };

  /**
   * The runs of an advice, of which each is computed once and stays on disk,
   * and how their histories differ. All of it is collective.
   */
  class AdviseRuns
  {
  public:
    /** @throw SceneError if the scene has no probes, or not what the user wants
     * to be compared. */
    AdviseRuns(const Command     &command,
               const Scene       &scene,
               const std::string &directory,
               const MPI_Comm     for_failures,
               StopRequests      &requests,
               Log               &log);

    /** The run with these settings, computed now if it is not there yet. A
     * scene that is refused is a run without results.
     *
     * @throw FileError, StoppedOnRequest */
    const AdviseRun &
    run(const std::string &name, const std::vector<Override> &settings);

    /** The relative difference of each quantity; infinite if there is none to
     * be told, 0 for what vanishes in the reference. */
    const std::vector<double> &
    differences(const AdviseRun &one, const AdviseRun &reference);

    /** The largest of them, but for what was left out. */
    double
    difference(const AdviseRun &one, const AdviseRun &reference);

    /** @throw SceneError if a run does not write one that is compared.
     * @throw NumericalError if all of them are zero. */
    void
    require_histories(const AdviseRun &run) const;

    const std::vector<Quantity> &
    quantities() const;

    /** From now on a quantity does not count. */
    void
    leave_out(const std::size_t quantity);

    bool
    counts(const std::size_t quantity) const;

    std::size_t
    n_that_count() const;

    /** Whether it is the periodic state that is compared, not the whole run. */
    bool
    periodic() const;

  private:
    /** What is on disk of a run, or what comes of it. */
    SweepResult
    find_or_compute(const SweepVariant &variant,
                    const std::string  &name,
                    bool               &was_there);

    std::vector<double>
    measure(const AdviseRun &one, const AdviseRun &reference) const;

    void
    tell(const AdviseRun &run, const bool was_there);

    std::string
    folder(const std::string &name) const;

    const Command         command;
    const std::string     directory;
    const MPI_Comm        communicator;
    const MPI_Comm        for_failures;
    StopRequests         &requests;
    Log                  &log;
    const bool            first_rank;
    const double          period;
    const Compared        compared;
    std::vector<Quantity> all_quantities;
    std::vector<bool>     left_out;

    std::map<std::string, AdviseRun> runs; ///< by name
    std::map<std::pair<std::string, std::string>, std::vector<double>> known;
  };
} // namespace Crevasse

#endif
