// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/log.h>
#include <crevasse/base/problems.h>

#include <iostream>
#include <unistd.h>

namespace Crevasse
{
  using namespace dealii;

  Log::Log(const MPI_Comm communicator, const bool quiet, const bool is_verbose)
    : is_verbose(is_verbose)
    , first_rank(Utilities::MPI::this_mpi_process(communicator) == 0)
    , quiet(quiet)
    // Under mpirun, processes have terminals of their own.
    , terminal(isatty(STDOUT_FILENO) == 1 &&
               Utilities::MPI::n_mpi_processes(communicator) == 1)
  {
  }



  void
  Log::open_file(const std::string &file_name, const bool is_continuing)
  {
    if (!first_rank)
      return;
    name = file_name;
    file.open(name, is_continuing ? std::ios::app : std::ios::trunc);
    file << earlier_lines << std::flush;
    earlier_lines.clear();
    require_written();
  }



  void
  Log::line(const std::string &text)
  {
    if (!first_rank)
      return;
    clear_progress();
    if (!quiet && !output_is_gone)
      std::cout << text << std::endl;
    keep(text);
    require_written();
  }



  void
  Log::warning(const std::string &text)
  {
    if (!first_rank)
      return;
    clear_progress();
    std::cerr << "crevasse: warning: " << text << std::endl;
    keep("  warning: " + text);
  }



  void
  Log::error(const std::string &text)
  {
    if (!first_rank)
      return;
    clear_progress();
    std::cerr << text << std::endl;
    if (file.is_open())
      file << text << std::endl;
  }



  void
  Log::require_written()
  {
    if (!name.empty() && !file)
      throw FileError("Cannot write " + name + ": is the disk full?");
    if (std::cout || output_is_gone)
      return;
    if (!file.is_open())
      throw FileError("Cannot write to the standard output.");
    // The terminal is closed, or the reader of a pipe has ended: the run is
    // worth more than these lines.
    output_is_gone = true;
    keep("  warning: the standard output cannot be written to any more.");
  }



  void
  Log::progress(const std::string &text)
  {
    if (!on_terminal())
      return;
    std::cout << '\r' << text << "\033[K" << std::flush;
    progress_shown = true;
  }



} // namespace Crevasse
