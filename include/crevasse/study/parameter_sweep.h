// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_study_parameter_sweep_h
#define crevasse_study_parameter_sweep_h

#include <crevasse/app/command_line.h>
#include <crevasse/base/log.h>
#include <crevasse/base/stop_request.h>
#include <crevasse/study/quantity.h>
#include <crevasse/study/stress_reader.h>
#include <crevasse/study/sweep_folder.h>
#include <crevasse/study/sweep_plan.h>
#include <crevasse/study/sweep_result.h>
#include <crevasse/study/sweep_scenes.h>
#include <crevasse/study/sweep_table.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace Crevasse
{
  /**
   * `crevasse sweep`: runs a scene for all points of a SweepPlan, one after the
   * other, and tabulates errors beside costs. What is finished stays on disk
   * and is not computed again.
   */
  class ParameterSweep
  {
  public:
    /** Reads the scenes of all points. @throw SceneError with all that is wrong
     * with them, and with the command line.
     *
     * @param for_failures a communicator that nothing else uses. */
    ParameterSweep(const Command &command,
                   const MPI_Comm for_failures,
                   StopRequests  &requests,
                   Log           &log);

    /** @throw FileError; what the reference run throws; NumericalError if no
     * point has results; StoppedOnRequest. */
    void
    run();

  private:
    /** Computes what is not there yet. */
    void
    compute_points();

    bool
    needs_reference() const;

    /** In words, for people. */
    std::string
    describe_reference() const;

    /** In a word, for comparison: what errors are measured, and against what.
     */
    std::string
    basis() const;

    SweepResult
    find_reference();

    /** The result of a point that is there already, with errors against the
     * present reference, or nothing. Collective. */
    std::optional<SweepResult>
    stored(const SweepVariant &variant, const SweepFolder &folder);

    /** On the first rank; status and costs are known. */
    void
    measure(const SweepVariant &variant,
            const SweepFolder  &folder,
            SweepResult        &result);

    /** @throw FileError if the file of the point is missing or damaged. */
    MeasuredError
    stress_error(const SweepFolder &folder, const SweepResult &result) const;

    /** "3 of 12: " */
    std::string
    numbered(const std::size_t number) const;

    /** Tells about a point and writes the table. Collective. */
    void
    conclude_point(const std::size_t  number,
                   const SweepResult &result,
                   const bool         was_there);

    const Command                 command;
    const MPI_Comm                communicator;
    const MPI_Comm                for_failures;
    StopRequests                 &requests;
    Log                          &log;
    const bool                    first_rank;
    const SweepPlan               plan;
    const SweepScenes             scenes;
    std::vector<Quantity>         quantities;
    std::string                   directory;
    std::unique_ptr<SweepTable>   table;
    std::unique_ptr<StressReader> reference_stress; ///< on the first rank
  };
} // namespace Crevasse

#endif
