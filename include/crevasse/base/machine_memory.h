// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_machine_memory_h
#define crevasse_base_machine_memory_h

#include <deal.II/base/mpi.h>

#include <string>
#include <vector>

namespace Crevasse
{
  /** A sum over the ranks of one machine. Collective. */
  double
  sum_on_machine(const double value, const MPI_Comm communicator);

  /** Bytes that the ranks of one machine have and can still get, as Linux says;
   * infinite if it does not say. Collective. */
  double
  available_memory(const MPI_Comm communicator);

  /** The largest resident memory of each rank so far, in bytes; on the first
   * rank. Collective. */
  std::vector<double>
  peak_memory_of_ranks(const MPI_Comm communicator);

  /** Bytes per second that this process gets by reading an array of this size,
   * or of 256 MB if that is less, over and over. It takes 0.1 s. */
  double
  read_bandwidth(const double bytes);

  /** "1.23 GB" */
  std::string
  gigabytes(const double bytes);
} // namespace Crevasse

#endif
