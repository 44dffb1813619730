// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_checkpoint_checkpoints_h
#define crevasse_checkpoint_checkpoints_h

#include <crevasse/base/log.h>
#include <crevasse/base/state_archive.h>
#include <crevasse/base/stop_request.h>
#include <crevasse/checkpoint/checkpoint_folder.h>

#include <functional>

namespace Crevasse
{
  /** Decides when a run writes checkpoints, and holds the checkpoint that it is
   * resumed from. CheckpointWriter documents their contents. */
  class Checkpoints
  {
  public:
    using Serialize = std::function<void(StateArchive &)>;

    /** The references must outlive the Checkpoints.
     *
     * @param directory output directory of the run.
     * @param scene all parameters of the scene.
     * @param every number of periods between checkpoints; 0: on request. */
    Checkpoints(StopRequests      &requests,
                Log               &log,
                const std::string &directory,
                const Summary     &scene,
                const unsigned int every);

    /** Resumes the run from the newest undamaged checkpoint, without changing
     * any file in the folder. Collective.
     * @throw FileError if there is no such checkpoint, SceneError if its scene
     * differs in a parameter that must not change. */
    void
    resume(const MPI_Comm communicator);

    /** Whether the run is still to be resumed from a checkpoint. */
    bool
    is_resuming() const
    {
      return archive != nullptr;
    }
    /** Archive to resume from, with the data that is the same on all ranks. */
    StateArchive &
    resumed()
    {
      return *archive;
    }
    /** The file from which the mesh of the resumed run is loaded. */
    std::string
    resumed_mesh() const
    {
      return folder.name(manifest.number) + mesh_file;
    }

    /** Manifest of the last checkpoint written, or else of the resumed one. */
    const CheckpointManifest &
    last_manifest() const
    {
      return manifest;
    }

    /** Sets the function that serialises the first part of a checkpoint. */
    void
    begin_with(const Serialize &serialize)
    {
      first_part = serialize;
    }
    /** Sets the names of the run's tables, to which a resumed run appends. */
    void
    set_tables(const std::vector<std::string> &names)
    {
      tables = names;
    }

    StopRequests          &requests;
    const std::string      directory; ///< output directory of the run
    const CheckpointFolder folder;
    const Summary          scene;

  private:
    template <int dim>
    friend class CheckpointWriter;

    using Position = std::pair<unsigned int, unsigned int>; // period, step

    static constexpr const char *common_file = "/common.bin";
    static constexpr const char *mesh_file   = "/mesh"; ///< mesh and fields

    /** Decides between two steps on a checkpoint or a stop. Collective. */
    StopRequests::Request
    ask(const Position &position);

    /** Records that the run has been resumed. */
    void
    has_resumed();

    /** Records a written checkpoint, and the seconds that it took. */
    void
    has_written(const CheckpointManifest &written, const double seconds);

    /** Ends the run by throwing StoppedOnRequest. */
    [[noreturn]] void
    stop() const;

    Log               &log;
    const unsigned int every;

    Serialize                     first_part;
    std::vector<std::string>      tables;
    std::unique_ptr<StateArchive> archive; ///< data to resume from
    CheckpointManifest            manifest;
    Position                      last = {0, 0}; ///< last checkpoint or resume

    /** Largest expected checkpoint, and writing time per byte, that of a slow
     * disk until measured: they predict the time that the next one takes. */
    double expected_bytes = 0., seconds_per_byte = 1. / 50e6;
  };
} // namespace Crevasse

#endif
