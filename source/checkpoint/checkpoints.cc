// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/checkpoint/checkpoints.h>
#include <crevasse/checkpoint/scene_difference.h>

#include <algorithm>
#include <cstdio>

namespace Crevasse
{
  using namespace dealii;

  Checkpoints::Checkpoints(StopRequests &requests, Log &log)
    : Checkpoints(requests, log, "", {}, 0)
  {
  }



  Checkpoints::Checkpoints(StopRequests      &requests,
                           Log               &log,
                           const std::string &directory,
                           const Summary     &scene,
                           const unsigned int every)
    : stop_requests(requests)
    , run_log(log)
    , directory(directory)
    , all(directory)
    , parameters(scene)
    , every(every)
  {
  }



  void
  Checkpoints::resume(const MPI_Comm communicator)
  {
    std::vector<char>        bytes;
    std::vector<std::string> warnings;
    collectively(communicator, [&]() {
      if (Utilities::MPI::this_mpi_process(communicator) != 0)
        return;
      const auto newest = all.newest(warnings);
      for (const std::string &warning : warnings)
        run_log.warning(warning);
      if (!newest)
        throw FileError(
          "--resume: there is no checkpoint in " + directory +
          "/checkpoint that could be used. Without --resume the run begins "
          "anew; [Output] Checkpoint every, or a request to stop, has "
          "checkpoints written.");
      require_same_scene(newest->scene, parameters);
      manifest = *newest;
      std::string fault;
      bytes =
        read_checked(all.file(manifest.number, CheckpointFolder::common_file),
                     manifest.common,
                     fault);
      if (!fault.empty())
        throw FileError(fault + ", though it was in order a moment ago.");
    });
    manifest = Utilities::MPI::broadcast(communicator, manifest, 0);
    archive  = std::make_unique<CommonArchive>(communicator,
                                              std::move(bytes),
                                              manifest.ranks);
    run_log.line("  resumed from " + all.name(manifest.number) + ": period " +
                 std::to_string(manifest.period) + ", before step " +
                 std::to_string(manifest.step + 1) +
                 (manifest.ranks == 1
                    ? ", by 1 process"
                    : ", by " + std::to_string(manifest.ranks) + " processes"));
  }



  bool
  Checkpoints::is_resuming() const
  {
    return archive != nullptr;
  }



  CommonArchive &
  Checkpoints::resumed()
  {
    return *archive;
  }



  const CheckpointManifest &
  Checkpoints::resumed_manifest() const
  {
    return manifest;
  }



  void
  Checkpoints::begin_with(const std::function<void(StateArchive &)> &serialize)
  {
    first_part = serialize;
  }



  const std::function<void(StateArchive &)> &
  Checkpoints::beginning() const
  {
    return first_part;
  }



  StopRequests &
  Checkpoints::requests()
  {
    return stop_requests;
  }



  StopRequests::Request
  Checkpoints::ask(const unsigned int period, const unsigned int step)
  {
    const StopRequests::Request request =
      stop_requests.poll(is_on() ? expected_bytes * seconds_per_byte : 0.);
    const bool is_due = every > 0 && step == 0 && period > 1 &&
                        (period - 1) % every == 0 &&
                        last != Position(period, step);
    return request == StopRequests::none && is_due ? StopRequests::checkpoint
                                                   : request;
  }



  void
  Checkpoints::expect(const double bytes)
  {
    expected_bytes = bytes;
  }



  void
  Checkpoints::set_tables(const std::vector<std::string> &names)
  {
    names_of_tables = names;
  }



  const std::vector<std::string> &
  Checkpoints::tables() const
  {
    return names_of_tables;
  }



  bool
  Checkpoints::is_on() const
  {
    return !directory.empty();
  }



  const CheckpointFolder &
  Checkpoints::folder() const
  {
    return all;
  }



  const Summary &
  Checkpoints::scene() const
  {
    return parameters;
  }



  void
  Checkpoints::has_resumed(const CheckpointManifest &from)
  {
    last = Position(from.period, from.step);
    archive.reset();
    stop_requests.skip_interval();
  }



  void
  Checkpoints::has_written(const CheckpointManifest &written,
                           const double              seconds)
  {
    last     = Position(written.period, written.step);
    manifest = written;
    stop_requests.skip_interval();
    std::size_t bytes = written.common.bytes;
    for (const FieldFile &file : written.fields)
      bytes += file.check.bytes;
    // Early ones are small: there is no stress of a whole period yet.
    seconds_per_byte = seconds / bytes;
    expected_bytes   = std::max(expected_bytes, double(bytes));
    char text[160];
    std::snprintf(
      text,
      sizeof(text),
      "  checkpoint %u in period %u before step %u: %.3g MB, %.3g s",
      written.number,
      written.period,
      written.step + 1,
      1e-6 * bytes,
      seconds);
    run_log.line(text);
  }



  void
  Checkpoints::stop() const
  {
    const std::string who =
      "stopped on request (" + stop_requests.reason() + ")";
    if (!is_on())
      throw StoppedOnRequest(who + '.');
    throw StoppedOnRequest(who + "; --resume continues from " +
                           all.name(manifest.number) + '.');
  }



  Log &
  Checkpoints::log() const
  {
    return run_log;
  }
} // namespace Crevasse
