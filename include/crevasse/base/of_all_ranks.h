// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_of_all_ranks_h
#define crevasse_base_of_all_ranks_h

#include <deal.II/base/mpi.h>

#include <vector>

namespace Crevasse
{
  /** Concatenates the lists of all ranks in their order. Collective. */
  template <typename T>
  std::vector<T>
  of_all_ranks(const MPI_Comm communicator, const std::vector<T> &local)
  {
    std::vector<T> all;
    for (const auto &of_rank :
         dealii::Utilities::MPI::all_gather(communicator, local))
      all.insert(all.end(), of_rank.begin(), of_rank.end());
    return all;
  }
} // namespace Crevasse

#endif
