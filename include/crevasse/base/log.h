// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_log_h
#define crevasse_base_log_h

#include <crevasse/base/summary.h>

#include <deal.II/base/mpi.h>

#include <fstream>
#include <string>

namespace Crevasse
{
  /** Log of the run: lines on the first rank's standard output (none if quiet)
   * and in log.txt, and a progress line that is overwritten on a terminal.
   * Throws a FileError if a line cannot be written. */
  class Log
  {
  public:
    /** @param is_verbose Whether callers should log details. */
    Log(const MPI_Comm communicator,
        const bool     quiet,
        const bool     is_verbose = false);

    /** Also writes lines to this file from now on, after all earlier lines.
     * @param is_continuing Whether to append to the file. */
    void
    open_file(const std::string &file_name, const bool is_continuing = false);

    void
    line(const std::string &text);

    /** Writes a warning to standard error, even if quiet, and to the file. */
    void
    warning(const std::string &text);

    /** Writes an error to standard error, even if quiet, and to the file, if
     * any. Never throws: this ends a run. */
    void
    error(const std::string &text);

    /** Overwrites the progress line on a terminal; otherwise does nothing. */
    void
    progress(const std::string &text);

    /** Lines of the log so far, as long as no file is open. */
    const std::string &
    lines() const
    {
      return earlier_lines;
    }

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

    /** Writes a line to the file, or saves it until the file is opened. */
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

    const bool first_rank;
    const bool quiet;
    const bool terminal;
    bool       progress_shown = false;
    bool output_is_gone = false; ///< whether nobody reads the output any more
    std::string   earlier_lines;
    std::string   name;
    std::ofstream file;
  };

  /** Logs a warning that only the end of a run knows, and adds it to the
   * summary. */
  inline void
  warn(const std::string &warning, Log &log, Summary &summary)
  {
    log.line("  warning: " + warning);
    summary["warnings"].push_back(warning);
  }
} // namespace Crevasse

#endif
