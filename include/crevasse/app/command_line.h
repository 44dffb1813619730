// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_app_command_line_h
#define crevasse_app_command_line_h

#include <optional>
#include <string>
#include <vector>

namespace Crevasse
{
  /** Exit statuses of the program, which scripts rely on. */
  enum ExitStatus
  {
    done              = 0,
    bad_input         = 2, ///< mistake found before the run
    numerical_failure = 3,
    file_failure      = 4,
    stopped           = 5 ///< on request, with a checkpoint
  };

  /** Contents of the command line. */
  struct Command
  {
    std::vector<std::string> words;
    std::string              scene_file;
    std::vector<std::string> overrides; ///< "Section/Name=value"
    std::string              output_directory;
    std::string              print_format; ///< prm, json, markdown or nothing
    std::string              picture;      ///< page of --picture, or nothing
    bool                     check   = false;
    bool                     quiet   = false;
    bool                     verbose = false;
    bool                     resume  = false;
    bool   force         = false; ///< whether to replace earlier results
    double wall_time     = 0.;    ///< seconds; 0: unlimited
    bool   stress_record = false; ///< whether to use StressWriter
    bool   trust_mesh    = false; ///< whether a .geo file may do anything
    std::optional<bool> bars;     ///< overrides [Output] Error bars
    double      accuracy = 0.;    ///< to which to repeat the scene; 0: one run
    std::string quantities;       ///< that must have the accuracy; or nothing

    /** Whether to exit at once: after help, version, or a reported mistake. */
    bool       exit   = false;
    ExitStatus status = done;
  };

  /** @param words the name of the program and its arguments. */
  Command
  parse_command_line(const std::vector<std::string> &words);

  /** Suggestion "; did you mean ...?" for a missing scene file: a command, or a
   * scene of its folder or of prm; empty if nothing is similar. */
  std::string
  similar_to(const std::string &scene_file);
} // namespace Crevasse

#endif
