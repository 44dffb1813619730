// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_machine_memory_h
#define crevasse_base_machine_memory_h

#include <deal.II/base/mpi.h>

#include <string>
#include <vector>

namespace Crevasse
{
  /** Sum of a value over the ranks on this machine. Collective. */
  double
  sum_on_machine(const double value, const MPI_Comm communicator);

  /** Memory in bytes that the ranks on this machine have and can still get, as
   * Linux reports it; infinite if unknown. Collective. */
  double
  available_memory(const MPI_Comm communicator);

  /** Peak resident memory of each rank so far, in bytes; on the first rank
   * only. Collective. */
  std::vector<double>
  peak_memory_of_ranks(const MPI_Comm communicator);

  /** Number of bytes as text, "1.23 GB". */
  std::string
  gigabytes(const double bytes);
} // namespace Crevasse

#endif
