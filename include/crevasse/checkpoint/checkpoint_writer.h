// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_checkpoint_checkpoint_writer_h
#define crevasse_checkpoint_checkpoint_writer_h

#include <crevasse/base/checkpointer.h>
#include <crevasse/base/collectively.h>
#include <crevasse/base/meters.h>
#include <crevasse/base/problems.h>
#include <crevasse/checkpoint/checkpoints.h>
#include <crevasse/checkpoint/field_archive.h>
#include <crevasse/model/body.h>
#include <crevasse/parameters/parameters.h>

namespace Crevasse
{
  /**
   * Writes the state of a run to a checkpoint, or restores it from one: the
   * first part set by Checkpoints::begin_with(), a header, and all
   * SerializationScopes. Data that is the same on all ranks is in common.bin;
   * the mesh and the fields are in the files that Triangulation::save() writes.
   */
  template <int dim>
  class CheckpointWriter : public Checkpointer
  {
  public:
    /** The arguments must outlive the CheckpointWriter.
     *
     * @param mesh the body's, which writes the fields.
     * @param n_stresses largest number of stress fields in a checkpoint.
     * @param search parameters of the search; see at_end_of_search().
     * @param header serialises the header, which a resumed run has read. */
    CheckpointWriter(Checkpoints                   &checkpoints,
                     const Body<dim>               &body,
                     Mesh<dim>                     &mesh,
                     const unsigned int             n_stresses,
                     const PeriodicStateParameters &search,
                     const Checkpoints::Serialize  &header)
      : checkpoints(checkpoints)
      , body(body)
      , mesh(mesh)
      , search(search)
      , header(header)
    {
      checkpoints.expected_bytes = sizeof(double) * n_stress_components<dim> *
                                   double(body.points.n_points()) * n_stresses;
    }

    /** Writes a due checkpoint. @throw StoppedOnRequest if asked to stop. */
    void
    between_steps(const unsigned int period, const unsigned int step) override
    {
      if (checkpoints.is_resuming())
        return resume();
      const StopRequests::Request request = checkpoints.ask({period, step});
      if (request == StopRequests::none)
        return;
      const bool is_kept = write(period, step);
      if (request != StopRequests::stop)
        return;
      if (!is_kept)
        throw FileError(
          "Stopped on request, but no checkpoint could be written. An older "
          "one may exist: try --resume.");
      checkpoints.stop();
    }

    /** Writes a checkpoint at the end of a search if a longer run is likely to
     * resume from it: checkpoints are enabled, or the search has not converged.
     * None is written if another mesh follows. */
    void
    at_end_of_search(const unsigned int period,
                     const bool         has_converged) override
    {
      checkpoints.requests.skip_interval(); // another mesh may follow
      if (checkpoints.is_resuming())
        return resume();
      const bool ends_run = has_converged || period > search.maximum_periods;
      if (ends_run &&
          (checkpoints.every > 0 || (search.tolerance > 0. && !has_converged)))
        write(period, 0);
    }

  private:
    void
    resume()
    {
      FieldArchive<dim> archive(std::move(checkpoints.resumed()), body, mesh);
      serialize_parts(archive);
      archive.section("end");
      checkpoints.has_resumed();
    }

    /** @return whether the checkpoint was written; if not, the log says why. */
    bool
    write(const unsigned int period, const unsigned int step)
    {
      const dealii::Timer timer;
      const Stopwatch     watch("checkpoints");
      const MPI_Comm      communicator = body.space.communicator();
      const auto          on_first     = [&](const std::function<void()> &f) {
        collectively(communicator, [&]() {
          if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
            f();
        });
      };
      StateArchive common(communicator);
      checkpoints.first_part(common);
      header(common);
      FieldArchive<dim> archive(std::move(common), body, mesh, bytes_of_cells);
      serialize_parts(archive);
      archive.section("end");
      bytes_of_cells = archive.bytes_of_cells();

      const CheckpointFolder &folder = checkpoints.folder;
      CheckpointManifest      manifest;
      manifest.period = period;
      manifest.step   = step;
      manifest.ranks  = dealii::Utilities::MPI::n_mpi_processes(communicator);
      manifest.scene  = checkpoints.scene;
      const std::size_t bytes = archive.bytes_to_save();
      try
        {
          on_first([&]() { manifest.number = folder.begin(bytes); });
          manifest.number =
            dealii::Utilities::MPI::broadcast(communicator, manifest.number, 0);
          const std::string path = folder.new_name(manifest.number);
          archive.save_fields(path + Checkpoints::mesh_file);
          on_first([&]() {
            write_file(path + Checkpoints::common_file, archive.bytes());
            folder.finish(manifest, checkpoints.tables);
          });
        }
      catch (const FileError &error)
        {
          if (manifest.number > 0)
            on_first([&]() { folder.abandon(manifest.number); });
          checkpoints.log.warning(std::string("no checkpoint was written: ") +
                                  error.what());
          return false;
        }
      checkpoints.has_written(manifest, timer.wall_time());
      return true;
    }

    Checkpoints                   &checkpoints;
    const Body<dim>               &body;
    Mesh<dim>                     &mesh;
    const PeriodicStateParameters &search;
    const Checkpoints::Serialize   header;
    std::vector<std::size_t>       bytes_of_cells; ///< sizes in last checkpoint
  };
} // namespace Crevasse

#endif
