// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_log_h
#define crevasse_base_log_h

#include <deal.II/base/mpi.h>

#include <fstream>
#include <string>

namespace Crevasse
{
  /** What the run tells: lines on the first rank's standard output (none if
   * quiet) and in log.txt, and on a terminal one line that is overwritten.
   * A line that cannot be written is a FileError. */
  class Log
  {
  public:
    /** @param is_verbose whether those who have more to tell should. */
    Log(const MPI_Comm communicator,
        const bool     quiet,
        const bool     is_verbose = false);

    /** From now on lines go to this file as well; those before are added.
     * @param is_continuing Whether what the file has already stays. */
    void
    open_file(const std::string &file_name, const bool is_continuing = false);

    void
    line(const std::string &text);

    /** On standard error, even if quiet, and in the file. */
    void
    warning(const std::string &text);

    /** On standard error, even if quiet, and in the file if there is one.
     * Throws nothing: this is the last word of a run. */
    void
    error(const std::string &text);

    /** Overwrites the progress line; nothing unless on a terminal. */
    void
    progress(const std::string &text);

    /** Whether progress() shows anything. */
    bool
    on_terminal() const
    {
      return first_rank && terminal && !quiet && !output_is_gone;
    }

    const bool is_verbose;

  private:
    void
    clear_progress()
    {
      if (progress_shown)
        std::cout << "\r\033[K";
      progress_shown = false;
    }

    /** In the file, also if it is opened later. */
    void
    keep(const std::string &text)
    {
      if (file.is_open())
        file << text << std::endl;
      else
        earlier_lines += text + '\n';
    }

    void
    require_written();

    const bool    first_rank;
    const bool    quiet;
    const bool    terminal;
    bool          progress_shown = false;
    bool          output_is_gone = false; ///< nobody reads it any more
    std::string   earlier_lines;
    std::string   name;
    std::ofstream file;
  };
} // namespace Crevasse

#endif
