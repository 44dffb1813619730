// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_single_process_h
#define crevasse_base_single_process_h

namespace Crevasse
{
  /** Prepares Open MPI for a single process; call it before MPI is initialised.
   * If neither mpirun nor srun started this process, environment variables
   * tell Open MPI to start no daemon, to look for no networks, and to make no
   * session directory, which short-lived processes would remove from each
   * other. Variables that are set already stay. */
  void
  set_up_single_process();
} // namespace Crevasse

#endif
