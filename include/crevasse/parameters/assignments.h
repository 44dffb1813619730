// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_assignments_h
#define crevasse_parameters_assignments_h

#include <crevasse/base/problems.h>

namespace Crevasse
{
  /** A parameter as a file or an option sets it, whether or not it exists. */
  struct Assignment
  {
    Origin origin;
    /** Names of nested sections joined by "/". */
    std::string section;
    /** Name of the parameter; empty where a section is only opened. */
    std::string name;
    std::string value;
  };

  /**
   * Reads the assignments of a .prm or .json file and then of the command line,
   * without checking their names. deal.II stops at the first error; this
   * function continues and reports all errors, also parameters that a file sets
   * twice. Files are included relative to the file that includes them; an
   * included file may set parameters of another file; the later value counts.
   *
   * JSON is what one writes by hand, {"Geometry": {"Width": 1, "Subdivisions":
   * [14, 4]}}, or what deal.II prints, where all values are texts, and a
   * parameter may be an object whose member "value" counts. "$schema" is
   * ignored: editors use it.
   *
   * @param overrides "Section/Name=value" of --set.
   * @throw FileError if the file cannot be read.
   */
  std::vector<Assignment>
  read_assignments(const std::string              &file_name,
                   const std::vector<std::string> &overrides,
                   Problems                       &problems);
} // namespace Crevasse

#endif
