// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Type of an exception that is sent to another rank. */
    enum ErrorKind : unsigned int
    {
      no_error,
      scene_error,
      numerical_error,
      file_error,
      other_error
    };



    ErrorKind
    kind_of(const std::exception &error)
    {
      return dynamic_cast<const SceneError *>(&error)       ? scene_error
             : dynamic_cast<const NumericalError *>(&error) ? numerical_error
             : dynamic_cast<const FileError *>(&error)      ? file_error
                                                            : other_error;
    }
  } // namespace



  void
  collectively(const MPI_Comm communicator, const std::function<void()> &f)
  {
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    if (n_ranks == 1)
      return f(); // exceptions pass unchanged

    std::string  message;
    unsigned int kind = no_error;
    try
      {
        f();
      }
    catch (const std::exception &error)
      {
        message = error.what();
        kind    = kind_of(error);
      }
    const unsigned int rank = Utilities::MPI::this_mpi_process(communicator);
    const unsigned int first =
      Utilities::MPI::min(kind == no_error ? n_ranks : rank, communicator);
    if (first == n_ranks)
      return;

    message = Utilities::MPI::broadcast(communicator, message, first);
    switch (Utilities::MPI::broadcast(communicator, kind, first))
      {
        case scene_error:
          throw SceneError(message);
        case numerical_error:
          throw NumericalError(message);
        case file_error:
          throw FileError(message);
        default:
          throw std::runtime_error(message);
      }
  }
} // namespace Crevasse
