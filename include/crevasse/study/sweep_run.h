// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_study_sweep_run_h
#define crevasse_study_sweep_run_h

#include <crevasse/base/stop_request.h>
#include <crevasse/parameters/scene.h>
#include <crevasse/study/sweep_folder.h>
#include <crevasse/study/sweep_result.h>

#include <deal.II/base/mpi.h>

#include <exception>

namespace Crevasse
{
  /** How a run of a sweep ended. */
  struct SweepRun
  {
    /** Status, message and costs; no errors yet. */
    SweepResult result;
    /** What it has thrown, if it was not done. */
    std::exception_ptr exception;
  };

  /**
   * Computes one scene of a sweep into its folder, as a run of its own would,
   * but without a word on the terminal, and keeps its stress where that is
   * wanted. Collective.
   *
   * @param for_failures a communicator that nothing else uses: if a rank alone
   * fails, all ranks end.
   * @throw FileError, StoppedOnRequest
   */
  SweepRun
  run_for_sweep(const Scene       &scene,
                const SweepFolder &folder,
                const bool         keep_stress,
                const MPI_Comm     for_failures,
                StopRequests      &requests);
} // namespace Crevasse

#endif
