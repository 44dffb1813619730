// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

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
