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
