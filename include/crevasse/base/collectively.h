// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_collectively_h
#define crevasse_base_collectively_h

#include <deal.II/base/mpi.h>

#include <functional>
#include <vector>

namespace Crevasse
{
  /**
   * Calls @p f on each rank. If @p f throws on some ranks, all ranks throw the
   * exception of the lowest of these ranks, with its type (SceneError,
   * NumericalError, FileError or another std::exception): an exception on one
   * rank alone would leave the others waiting at the next communication.
   * Collective; @p f must not communicate.
   */
  void
  collectively(const MPI_Comm communicator, const std::function<void()> &f);

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
