// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/checkpoint/checkpoint_writer.h>
#include <crevasse/checkpoint/field_archive.h>
#include <crevasse/checkpoint/field_files.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    std::string
    name_of_fields(const unsigned int rank)
    {
      return "fields_" + std::to_string(rank) + ".bin";
    }



    /** What each rank's file has. Collective. */
    template <int dim>
    std::vector<FieldFile>
    files_of_all_ranks(const CellwiseFields<dim> &fields,
                       const FileCheck           &check,
                       const MPI_Comm             communicator)
    {
      using Numbers               = std::vector<std::size_t>;
      const Numbers          mine = {check.bytes,
                                     check.crc,
                                     fields.first_cell(),
                                     fields.n_cells()};
      std::vector<FieldFile> files;
      for (const Numbers &of : Utilities::MPI::all_gather(communicator, mine))
        files.push_back({name_of_fields(files.size()),
                         {of[0], static_cast<std::uint32_t>(of[1])},
                         of[2],
                         of[3]});
      return files;
    }
  } // namespace



  template <int dim>
  CheckpointWriter<dim>::CheckpointWriter(Checkpoints       &checkpoints,
                                          const Body<dim>   &body,
                                          const unsigned int n_stresses,
                                          const unsigned int last_period,
                                          const Header      &header)
    : checkpoints(checkpoints)
    , body(body)
    , last_period(last_period)
    , header(header)
  {
    checkpoints.expect(sizeof(double) * n_stress_components<dim> *
                       double(body.points.n_points()) * n_stresses);
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
    const StopRequests::Request request = checkpoints.ask(period, step);
    if (request == StopRequests::none)
      return;
    const bool is_kept = !checkpoints.is_on() || write(period, step);
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
    if (checkpoints.is_on() && period == last_period + 1 && last_period > 0)
      write(period, 0);
  }



  template <int dim>
  void
  CheckpointWriter<dim>::resume()
  {
    const CheckpointManifest         manifest = checkpoints.resumed_manifest();
    const CellwiseFields<dim>        fields(body);
    std::unique_ptr<FieldFileReader> reader;
    collectively(body.space.communicator(), [&]() {
      reader = std::make_unique<FieldFileReader>(checkpoints.folder().name(
                                                   manifest.number),
                                                 manifest.fields,
                                                 fields.first_cell(),
                                                 fields.n_points());
    });
    FieldArchive<dim> archive(std::move(checkpoints.resumed()),
                              fields,
                              *reader);
    serialize_parts(archive);
    archive.section("end");
    checkpoints.has_resumed(manifest);
  }



  template <int dim>
  bool
  CheckpointWriter<dim>::write(const unsigned int period,
                               const unsigned int step)
  {
    const Timer        timer;
    const MPI_Comm     communicator = body.space.communicator();
    const unsigned int rank = Utilities::MPI::this_mpi_process(communicator);
    const CheckpointFolder &folder = checkpoints.folder();
    CheckpointManifest      manifest;
    manifest.period = period;
    manifest.step   = step;
    manifest.ranks  = Utilities::MPI::n_mpi_processes(communicator);
    manifest.scene  = checkpoints.scene();
    try
      {
        collectively(communicator, [&]() {
          if (rank == 0)
            manifest.number = folder.begin();
        });
        manifest.number =
          Utilities::MPI::broadcast(communicator, manifest.number, 0);

        const CellwiseFields<dim>        fields(body);
        std::unique_ptr<FieldFileWriter> writer;
        collectively(communicator, [&]() {
          writer = std::make_unique<FieldFileWriter>(
            folder.new_file(manifest.number, name_of_fields(rank)),
            fields.n_points());
        });
        CommonArchive common(communicator);
        checkpoints.beginning()(common);
        header(common);
        FieldArchive<dim> archive(std::move(common), fields, *writer);
        serialize_parts(archive);
        archive.section("end");

        FileCheck mine;
        collectively(communicator, [&]() { mine = writer->finish(); });
        manifest.fields = files_of_all_ranks(fields, mine, communicator);
        collectively(communicator, [&]() {
          if (rank != 0)
            return;
          CheckedFile file(
            folder.new_file(manifest.number, CheckpointFolder::common_file));
          file.write(archive.bytes().data(), archive.bytes().size());
          manifest.common = file.finish();
          manifest.tables = folder.measure_tables(checkpoints.tables());
          folder.finish(manifest);
        });
      }
    catch (const FileError &error)
      {
        if (rank == 0)
          folder.abandon(manifest.number);
        checkpoints.log().warning(std::string("no checkpoint was written: ") +
                                  error.what());
        return false;
      }
    checkpoints.has_written(manifest, timer.wall_time());
    return true;
  }



  template class CheckpointWriter<2>;
  template class CheckpointWriter<3>;
} // namespace Crevasse
