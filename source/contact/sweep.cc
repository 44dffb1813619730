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

#include <crevasse/contact/block_sweep.h>
#include <crevasse/contact/point_sweep.h>
#include <crevasse/contact/sweep.h>
#include <crevasse/scene/problems.h>

#include <deal.II/base/mpi.h>

namespace Crevasse
{
  void
  require_one_rank(const MPI_Comm communicator)
  {
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) > 1)
      throw SceneError(
        "[Contact] Solver = projected sor: it sweeps through all unknowns in "
        "order and works on one process only. Start the program without "
        "mpirun, or choose automatic, active set or condensed active set.");
  }



  std::unique_ptr<const Sweep>
  make_sweep(const SignoriniProblem &problem, const UnknownBlocks &blocks)
  {
    require_one_rank(problem.matrix.get_mpi_communicator());
    if (blocks.empty())
      return std::make_unique<PointSweep>(problem);
    return std::make_unique<BlockSweep>(problem, blocks);
  }
} // namespace Crevasse
