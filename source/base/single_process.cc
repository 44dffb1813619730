// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/single_process.h>

#include <cstdlib>

namespace Crevasse
{
  void
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
