// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/checkpoint/checkpoint_writer.h>
#include <crevasse/checkpoint/field_archive.h>


namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  CheckpointWriter<dim>::CheckpointWriter(Checkpoints       &checkpoints,
                                          const Body<dim>   &body,
                                          const unsigned int n_stresses,
                                          const unsigned int last_period,
                                          const Checkpoints::Serialize &header)
    : checkpoints(checkpoints)
    , body(body)
    , last_period(last_period)
    , header(header)
  {
    checkpoints.expected_bytes = sizeof(double) * n_stress_components<dim> *
                                 double(body.points.n_points()) * n_stresses;
  }



  template <int dim>
  void
  CheckpointWriter<dim>::between_steps(const unsigned int period,
                                       const unsigned int step)
  {
    if (checkpoints.is_resuming())
      {
        resume();
        return;
      }
    const StopRequests::Request request = checkpoints.ask({period, step});
    if (request == StopRequests::none)
      return;
    const bool is_kept = write(period, step);
    if (request != StopRequests::stop)
      return;
    if (!is_kept)
      throw FileError(
        "Stopped on request, but no checkpoint could be written. "
        "An older one may be there: try --resume.");
    checkpoints.stop();
  }



  template <int dim>
  void
  CheckpointWriter<dim>::at_end_of_search(const unsigned int period)
  {
    if (period == last_period + 1 && last_period > 0)
      write(period, 0);
  }



  template <int dim>
  void
  CheckpointWriter<dim>::resume()
  {
    FieldArchive<dim> archive(std::move(checkpoints.resumed()), body);
    serialize_parts(archive);
    archive.section("end");
    checkpoints.has_resumed();
  }



  template <int dim>
  bool
  CheckpointWriter<dim>::write(const unsigned int period,
                               const unsigned int step)
  {
    const Timer    timer;
    const MPI_Comm communicator = body.space.communicator();
    const auto     on_first     = [&](const std::function<void()> &f) {
      collectively(communicator, [&]() {
        if (Utilities::MPI::this_mpi_process(communicator) == 0)
          f();
      });
    };
    CommonArchive common(communicator);
    checkpoints.first_part(common);
    header(common);
    FieldArchive<dim> archive(std::move(common), body, bytes_of_cells);
    serialize_parts(archive);
    archive.section("end");
    bytes_of_cells = archive.bytes_of_cells();

    const CheckpointFolder &folder = checkpoints.folder;
    CheckpointManifest      manifest;
    manifest.period         = period;
    manifest.step           = step;
    manifest.ranks          = Utilities::MPI::n_mpi_processes(communicator);
    manifest.scene          = checkpoints.scene;
    const std::size_t bytes = archive.bytes_to_save();
    try
      {
        on_first([&]() { manifest.number = folder.begin(bytes); });
        manifest.number =
          Utilities::MPI::broadcast(communicator, manifest.number, 0);
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



  template class CheckpointWriter<2>;
  template class CheckpointWriter<3>;
} // namespace Crevasse
