// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_app_command_line_h
#define crevasse_app_command_line_h

#include <string>
#include <vector>

namespace Crevasse
{
  /** The exit statuses that scripts rely on. */
  enum ExitStatus
  {
    done              = 0,
    bad_input         = 2, ///< found before computing
    numerical_failure = 3,
    file_failure      = 4,
    stopped           = 5 ///< on request; a checkpoint was written
  };

  /** What the command line says. */
  struct Command
  {
    std::string              scene_file;
    std::vector<std::string> overrides; ///< "Section/Name=value"
    std::string              output_directory;
    std::string              print_format; ///< prm, json, markdown or nothing
    bool                     check   = false;
    bool                     quiet   = false;
    bool                     verbose = false;
    bool                     resume  = false;
    bool                     force   = false; ///< earlier results are replaced
    double                   wall_time     = 0.;    ///< seconds; 0: any
    bool                     stress_record = false; ///< see StressWriter

    /** Set if there is nothing to do but to exit: help, version, or a mistake,
     * about which the user has been told. */
    bool       exit   = false;
    ExitStatus status = done;
  };

  Command
  parse_command_line(const int argc, const char *const *argv);

  /** "; did you mean ...?" for a scene file that does not exist: a command, or
   * a scene of its folder or of prm; or nothing. */
  std::string
  similar_to(const std::string &scene_file);
} // namespace Crevasse

#endif
