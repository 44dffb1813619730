// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/app/command_line.h>
#include <crevasse/app/failure.h>
#include <crevasse/base/problems.h>

#include <chrono>
#include <iostream>
#include <thread>

namespace Crevasse
{
  namespace
  {
    /** Whether all ranks arrive within some seconds; if only one rank has an
     * error, the others wait elsewhere. */
    bool
    all_ranks_arrive(const MPI_Comm communicator)
    {
      using namespace std::chrono;
      constexpr std::chrono::seconds patience(10);

      // A nonblocking barrier, apart from communication of the other ranks.
      MPI_Request request;
      int         arrived = 0;
      MPI_Ibarrier(communicator, &request);
      const auto start = steady_clock::now();
      while (arrived == 0 && steady_clock::now() - start < patience)
        {
          std::this_thread::sleep_for(milliseconds(10));
          MPI_Test(&request, &arrived, MPI_STATUS_IGNORE);
        }
      return arrived != 0;
    }
  } // namespace



  int
  exit_status_of(const std::exception &error)
  {
    if (dynamic_cast<const SceneError *>(&error) != nullptr)
      return bad_input;
    if (dynamic_cast<const FileError *>(&error) != nullptr)
      return file_failure;
    return numerical_failure;
  }



  int
  report_failure(const std::exception &error,
                 const MPI_Comm        communicator,
                 Log                  &log)
  {
    const std::string message = std::string("crevasse: ") + error.what();
    const int         status  = exit_status_of(error);
    log.error(message);

    int n_ranks, rank;
    MPI_Comm_size(communicator, &n_ranks);
    MPI_Comm_rank(communicator, &rank);
    if (n_ranks > 1 && !all_ranks_arrive(communicator))
      {
        if (rank != 0) // only rank 0 logs
          std::cerr << message << " (rank " << rank << ')' << std::endl;
        MPI_Abort(communicator, status);
      }
    return status;
  }
} // namespace Crevasse
