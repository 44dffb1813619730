// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_json_reader_h
#define crevasse_parameters_json_reader_h

#include <crevasse/parameters/assignments.h>

#include <string>
#include <vector>

namespace Crevasse
{
  /**
   * Appends what a JSON file sets, without knowing what may be set. It
   * understands what one writes by hand, {"Geometry": {"Width": 1,
   * "Subdivisions": [14, 4]}}, and what deal.II prints, where all values are
   * texts, a parameter may be an object whose member "value" counts, and names
   * may be mangled ("Output_20directory").
   *
   * @throw FileError if the file cannot be read.
   */
  void
  read_json(const std::string       &file_name,
            std::vector<Assignment> &assignments,
            Problems                &problems);
} // namespace Crevasse

#endif
