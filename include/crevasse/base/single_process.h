// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_single_process_h
#define crevasse_base_single_process_h

#include <cstdlib>
#include <string>

namespace Crevasse
{
  /** Whether this is the only process, or mpirun's first; before and after MPI,
   * too. */
  inline bool
  is_first_process()
  {
    const char *rank = std::getenv("OMPI_COMM_WORLD_RANK");
    return rank == nullptr || std::string(rank) == "0";
  }



  /** Prepares Open MPI for a single process; call it before MPI is initialised.
   * If neither mpirun nor srun started this process, environment variables
   * tell Open MPI to start no daemon, to look for no networks, and to make no
   * session directory, which short-lived processes would remove from each
   * other. Variables that are set already stay. */
  inline void
  set_up_single_process()
  {
    for (const char *of_launchers : {"OMPI_COMM_WORLD_SIZE",
                                     "PMIX_RANK",
                                     "PMI_RANK",
                                     "PMI_FD",
                                     "SLURM_STEP_ID",
                                     "ALPS_APP_PE"})
      if (std::getenv(of_launchers) != nullptr)
        return;
    setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
    setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
    // This component needs no session directory when checkpoints are opened.
    setenv("OMPI_MCA_sharedfp", "individual", 0);
    setenv("OMPI_MCA_pml", "ob1", 0);
    setenv("OMPI_MCA_btl", "self", 0);
  }
} // namespace Crevasse

#endif
