// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// What it takes to look for requests to stop, once a step: a reduction of one
// integer, and on the first rank a look for a file and at the clock.
//
//     ninja stop_request_cost
//     cd DIRECTORY && mpirun -np 4 BUILD/tests/benchmarks/stop_request_cost
//
// DIRECTORY, where the file is looked for, is on the file system in question.

#include <crevasse/base/stop_request.h>

#include <cstdio>

using namespace Crevasse;

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  constexpr unsigned int n_looks = 100000;
  constexpr double       a_day   = 86400.;
  StopRequests           requests(MPI_COMM_WORLD, a_day);
  requests.look_in(".");
  unsigned int        n_requests = 0;
  const dealii::Timer timer;
  for (unsigned int k = 0; k < n_looks; ++k)
    if (requests.poll(0.) != StopRequests::none)
      ++n_requests;
  const double seconds =
    dealii::Utilities::MPI::max(timer.wall_time(), MPI_COMM_WORLD);
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::printf("%u processes: %.2f microseconds a look, %u requests\n",
                dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD),
                1e6 * seconds / n_looks,
                n_requests);
  return 0;
}
