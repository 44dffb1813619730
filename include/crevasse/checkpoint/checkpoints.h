// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_checkpoint_checkpoints_h
#define crevasse_checkpoint_checkpoints_h

#include <crevasse/base/log.h>
#include <crevasse/base/stop_request.h>
#include <crevasse/checkpoint/checkpoint_folder.h>
#include <crevasse/checkpoint/common_archive.h>

#include <functional>

namespace Crevasse
{
  /** The checkpoints of one run: when they are written, and the one that it is
   * resumed from. CheckpointWriter documents what they contain. */
  class Checkpoints
  {
  public:
    using Serialize = std::function<void(StateArchive &)>;

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

    /** Resumes the run from the newest checkpoint that is in order. Nothing in
     * the folder is changed. Collective.
     * @throw FileError if there is none, SceneError if its scene differs from
     * this one in what matters. */
    void
    resume(const MPI_Comm communicator);

    /** Whether a run is to be resumed, as long as it has not been. */
    bool
    is_resuming() const
    {
      return archive != nullptr;
    }
    /** What all ranks have alike of the resumed run. */
    CommonArchive &
    resumed()
    {
      return *archive;
    }
    /** The file that its mesh is loaded from. */
    std::string
    resumed_mesh() const
    {
      return folder.name(manifest.number) + mesh_file;
    }

    /** After resume(), that one; afterwards the last one that was written. */
    const CheckpointManifest &
    last_manifest() const
    {
      return manifest;
    }

    /** What a checkpoint begins with. */
    void
    begin_with(const Serialize &serialize)
    {
      first_part = serialize;
    }
    /** Names the tables that the run writes, which go on when it is
     * resumed. */
    void
    set_tables(const std::vector<std::string> &names)
    {
      tables = names;
    }

    StopRequests          &requests;
    const CheckpointFolder folder;
    const Summary          scene;

  private:
    template <int dim>
    friend class CheckpointWriter;

    using Position = std::pair<unsigned int, unsigned int>; // period, step

    static constexpr const char *common_file = "/common.bin";
    static constexpr const char *mesh_file   = "/mesh"; ///< and its fields

    /** What is to be done between two steps. Collective. */
    StopRequests::Request
    ask(const Position &position);

    /** Notes that the run was resumed. */
    void
    has_resumed();

    /** Notes that one was written, and what it took. */
    void
    has_written(const CheckpointManifest &written, const double seconds);

    /** Ends the run. */
    [[noreturn]] void
    stop() const;

    Log               &log;
    const std::string  directory;
    const unsigned int every;

    Serialize                      first_part;
    std::vector<std::string>       tables;
    std::unique_ptr<CommonArchive> archive; ///< of the run to be resumed
    CheckpointManifest             manifest;
    Position                       last = {0, 0}; ///< of which there is one

    /** How large they may become, and that of a slow disk, until it is
     * measured: this tells how long the next one may take. */
    double expected_bytes = 0., seconds_per_byte = 1. / 50e6;
  };
} // namespace Crevasse

#endif
