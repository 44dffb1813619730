// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_assignments_h
#define crevasse_parameters_assignments_h

#include <crevasse/base/problems.h>

namespace Crevasse
{
  /** One parameter as somebody set it, whether or not it exists. */
  struct Assignment
  {
    Origin origin;
    /** Names joined by "/" where sections are nested. */
    std::string section;
    /** Empty: the section is only opened here. */
    std::string name;
    std::string value;
  };

  /**
   * What a .prm or .json file and then the command line set, without knowing
   * what may be set. Other than deal.II, which stops at the first error, this
   * goes on after what it does not understand and reports it all; and a
   * parameter that one file sets twice is an error. Files are included
   * relative to the file that includes them; an included file may set what
   * another file sets as well; the later one counts.
   *
   * JSON is what one writes by hand, {"Geometry": {"Width": 1, "Subdivisions":
   * [14, 4]}}, or what deal.II prints, where all values are texts, and a
   * parameter may be an object whose member "value" counts. "$schema" is left
   * to editors.
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
