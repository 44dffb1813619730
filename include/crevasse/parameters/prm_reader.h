// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_prm_reader_h
#define crevasse_parameters_prm_reader_h

#include <crevasse/parameters/assignments.h>

#include <string>
#include <vector>

namespace Crevasse
{
  /**
   * Appends what a file in deal.II's .prm format sets, without knowing what may
   * be set. Other than deal.II, which stops at the first error, it goes on
   * after lines that it does not understand and reports them all; files are
   * included relative to the file that includes them; and a parameter that one
   * file sets twice is an error. An included file may set what another file
   * sets as well; the later one counts.
   *
   * @throw FileError if the file itself cannot be read.
   */
  void
  read_prm(const std::string       &file_name,
           std::vector<Assignment> &assignments,
           Problems                &problems);
} // namespace Crevasse

#endif
