// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/base/text_file.h>
#include <crevasse/checkpoint/checkpoints.h>
#include <crevasse/checkpoint/scene_difference.h>

#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  Checkpoints::Checkpoints(StopRequests      &requests,
                           Log               &log,
                           const std::string &directory,
                           const Summary     &scene,
                           const unsigned int every)
    : requests(requests)
    , directory(directory)
    , folder(directory)
    , scene(scene)
    , log(log)
    , every(every)
  {
  }



  void
  Checkpoints::resume(const MPI_Comm communicator)
  {
    std::string bytes;
    collectively(communicator, [&]() {
      if (Utilities::MPI::this_mpi_process(communicator) != 0)
        return;
      std::vector<std::string> warnings;
      const auto               newest = folder.newest(warnings);
      for (const std::string &warning : warnings)
        log.warning(warning);
      if (!newest)
        throw FileError("--resume: there is no checkpoint in " + directory +
                        "/checkpoint that could be used. Start again without "
                        "--resume; [Output] Checkpoint every, or a request to "
                        "stop, makes the program write checkpoints.");
      require_same_scene(newest->scene, scene);
      manifest = *newest;
      bytes    = read_text_file(folder.name(manifest.number) + common_file);
    });
    manifest = Utilities::MPI::broadcast(communicator, manifest, 0);
    archive  = std::make_unique<StateArchive>(
      communicator,
      Utilities::MPI::broadcast(communicator, bytes, 0),
      manifest.ranks);
    log.line("  resumed from " + folder.name(manifest.number) + ": period " +
             std::to_string(manifest.period) + ", before step " +
             std::to_string(manifest.step + 1) +
             (manifest.ranks == 1
                ? ", by 1 process"
                : ", by " + std::to_string(manifest.ranks) + " processes"));
  }



  StopRequests::Request
  Checkpoints::ask(const Position &position)
  {
    const StopRequests::Request request =
      requests.poll(expected_bytes * seconds_per_byte);
    const auto &[period, step] = position;
    const bool is_due          = every > 0 && step == 0 && period > 1 &&
                        (period - 1) % every == 0 && last != position;
    return request == StopRequests::none && is_due ? StopRequests::checkpoint
                                                   : request;
  }



  void
  Checkpoints::has_resumed()
  {
    last = Position(manifest.period, manifest.step);
    archive.reset();
    requests.skip_interval();
  }



  void
  Checkpoints::has_written(const CheckpointManifest &written,
                           const double              seconds)
  {
    last     = Position(written.period, written.step);
    manifest = written;
    requests.skip_interval();
    // Early checkpoints are small: they lack the stress of a whole period.
    const double bytes = std::max<double>(1., written.bytes());
    seconds_per_byte   = seconds / bytes;
    expected_bytes     = std::max(expected_bytes, bytes);
    log.line(Text::format(
      "  checkpoint %u in period %u before step %u: %.3g MB, %.3g s",
      written.number,
      written.period,
      written.step + 1,
      1e-6 * bytes,
      seconds));
  }



  void
  Checkpoints::stop() const
  {
    throw StoppedOnRequest("stopped on request (" + requests.reason() +
                           "); --resume continues from " +
                           folder.name(manifest.number) + '.');
  }
} // namespace Crevasse
