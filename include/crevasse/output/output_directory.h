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

#ifndef crevasse_output_output_directory_h
#define crevasse_output_output_directory_h

#include <string>

namespace Crevasse
{
  /** Creates the directory and its parents where needed and makes sure that
   * files can be written there. @throw FileError otherwise. */
  void
  require_writable_directory(const std::string &directory);

  /**
   * Removes what an earlier run has written there, so that nothing of it is
   * taken for a result of this one. Other files stay, and so does everything
   * where no used.prm tells that there was a run.
   *
   * @throw FileError if something cannot be removed, or a directory has the
   * name of a file that is to be written.
   */
  void
  remove_earlier_results(const std::string &directory);
} // namespace Crevasse

#endif
