// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_single_process_h
#define crevasse_base_single_process_h

namespace Crevasse
{
  /** To be called before MPI is initialised. If no mpirun, srun or the like has
   * started this process, it tells Open MPI by the environment to start no
   * daemon, to look for no networks, and to make no directory for the session,
   * which processes that begin and end at once would remove from each other.
   * What the environment says already stays. */
  void
  set_up_single_process();
} // namespace Crevasse

#endif
