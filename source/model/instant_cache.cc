// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

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
