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

  /** "1.23 GB" */
  std::string
  gigabytes(const double bytes);
} // namespace Crevasse

#endif
