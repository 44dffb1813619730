// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_checkpoint_checkpoints_h
#define crevasse_checkpoint_checkpoints_h

#include <crevasse/base/log.h>
#include <crevasse/base/stop_request.h>
#include <crevasse/checkpoint/checkpoint_folder.h>
#include <crevasse/checkpoint/common_archive.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace Crevasse
{
  /** The checkpoints of one run: when they are written, and the one that it is
   * resumed from. CheckpointWriter documents what they contain. */
  class Checkpoints
  {
  public:
    /** None are written; the run can be stopped all the same. */
    Checkpoints(StopRequests &requests, Log &log);

    /** References must outlive this object.
     *
     * @param directory where the run writes to.
     * @param scene every parameter.
     * @param every so many periods one is written; 0: only on request. */
    Checkpoints(StopRequests      &requests,
                Log               &log,
                const std::string &directory,
                const Summary     &scene,
                const unsigned int every);

    /** Takes the run up from the newest checkpoint that is in order. Nothing
     * in the folder is changed. Collective.
     * @throw FileError if there is none, SceneError if its scene differs from
     * this one in what matters. */
    void
    resume(const MPI_Comm communicator);

    /** Whether a run is to be resumed, as long as it has not been. */
    bool
    is_resuming() const;

    /** What all ranks have alike of the resumed run. */
    CommonArchive &
    resumed();

    const CheckpointManifest &
    resumed_manifest() const;

    /** What a checkpoint begins with. */
    void
    begin_with(const std::function<void(StateArchive &)> &serialize);

    const std::function<void(StateArchive &)> &
    beginning() const;

    StopRequests &
    requests();

    /** What is to be done between two steps. Collective. */
    StopRequests::Request
    ask(const unsigned int period, const unsigned int step);

    /** How large they may become, in bytes of all ranks: this tells how long
     * the next one may take. */
    void
    expect(const double bytes);

    /** Names the tables that the run writes, which go on when it is
     * resumed. */
    void
    set_tables(const std::vector<std::string> &names);

    const std::vector<std::string> &
    tables() const;

    /** Whether any are written. */
    bool
    is_on() const;

    const CheckpointFolder &
    folder() const;

    const Summary &
    scene() const;

    /** Notes that the run was resumed. */
    void
    has_resumed(const CheckpointManifest &from);

    /** Notes that one was written, and what it took. */
    void
    has_written(const CheckpointManifest &manifest, const double seconds);

    /** Ends the run. */
    [[noreturn]] void
    stop() const;

    Log &
    log() const;

  private:
    using Position = std::pair<unsigned int, unsigned int>; // period, step

    StopRequests    &stop_requests;
    Log             &run_log;
    std::string      directory;
    CheckpointFolder all;
    Summary          parameters;
    unsigned int     every = 0;

    std::function<void(StateArchive &)> first_part;
    std::unique_ptr<CommonArchive>      archive; ///< of the run to be resumed
    CheckpointManifest                  manifest;
    std::optional<Position>             last; ///< of which there is one
    std::vector<std::string>            names_of_tables;

    double expected_bytes = 0.;
    /** That of a slow disk, until it is measured. */
    double seconds_per_byte = 1. / 50e6;
  };
} // namespace Crevasse

#endif
