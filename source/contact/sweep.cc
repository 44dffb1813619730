// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/contact/block_sweep.h>
#include <crevasse/contact/point_sweep.h>
#include <crevasse/contact/root_sweep.h>
#include <crevasse/contact/sweep.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace Crevasse
{
  SweepCount
  Sweep::sweep_until(const Vector      &right_hand_side,
                     Vector            &solution,
                     const double       relaxation_factor,
                     const double       target,
                     const unsigned int maximum_sweeps) const
  {
    SweepCount count;
    while (count.sweeps < maximum_sweeps)
      {
        count.largest_residual =
          (*this)(right_hand_side, solution, relaxation_factor);
        ++count.sweeps;
        if (count.largest_residual <= target ||
            !std::isfinite(count.largest_residual))
          break;
      }
    return count;
  }



  std::unique_ptr<const Sweep>
  make_sweep(const SignoriniProblem &problem, const UnknownBlocks &blocks)
  {
    if (dealii::Utilities::MPI::n_mpi_processes(
          problem.stiffness.get_mpi_communicator()) > 1)
      return std::make_unique<RootSweep>(problem, blocks);
    return make_local_sweep(problem, blocks);
  }



  std::unique_ptr<const Sweep>
  make_local_sweep(const SignoriniProblem &problem, const UnknownBlocks &blocks)
  {
    if (blocks.empty())
      return std::make_unique<PointSweep>(problem);
    return std::make_unique<BlockSweep>(problem, blocks);
  }
} // namespace Crevasse
