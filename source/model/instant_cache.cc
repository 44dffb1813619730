// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/model/instant_cache.h>

namespace Crevasse
{
  InstantMemory::InstantMemory(const MPI_Comm communicator,
                               const double   bytes,
                               Log           &log)
    : communicator(communicator)
    , limit(bytes)
    , log(log)
  {
  }



  void
  InstantMemory::count(const std::function<std::size_t()> &bytes_kept)
  {
    caches.push_back(bytes_kept);
  }



  bool
  InstantMemory::grants(const std::size_t bytes)
  {
    if (is_full)
      return false;
    std::size_t all = bytes;
    for (const auto &bytes_kept : caches)
      all += bytes_kept();
    is_full = dealii::Utilities::MPI::sum(double(all), communicator) > limit;
    if (is_full)
      log.line(
        "  memory: [Linear solver] Memory for instants is used up; what "
        "varies in time is made anew for the other instants");
    return !is_full;
  }
} // namespace Crevasse
