// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_machine_memory_h
#define crevasse_base_machine_memory_h

#include <deal.II/base/mpi.h>

#include <string>
#include <vector>

namespace Crevasse
{
  /** Checks that the ranks on each machine find the memory that they need: a
   * run without it would be killed without a message, or block the machine.
   * Linux reports what is left, also in a control group. Collective.
   *
   * @param bytes Estimate of what this rank needs.
   * @param of_libraries The part of it that no smaller mesh would save.
   * @param n_unknowns Unknowns of the mesh.
   * @param what Beginning of the message, "The run".
   * @param advice How to need less.
   * @throw SceneError, with what would fit, if there is less memory. */
  void
  require_memory(const double       bytes,
                 const double       of_libraries,
                 const double       n_unknowns,
                 const MPI_Comm     communicator,
                 const std::string &what,
                 const std::string &advice);

  /** Peak resident memory of each rank so far, in bytes; on the first rank
   * only. Collective. */
  std::vector<double>
  peak_memory_of_ranks(const MPI_Comm communicator);
} // namespace Crevasse

#endif
