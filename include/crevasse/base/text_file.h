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

#ifndef crevasse_base_text_file_h
#define crevasse_base_text_file_h

#include <string>

namespace Crevasse
{
  /** Why nothing can be read from a file, as "cannot be read: it is a
   * directory"; nothing if it can. */
  std::string
  why_unreadable(const std::string &file_name);

  /** The whole text of a file, without the byte order mark that some editors
   * put first.
   *
   * @throw FileError with the system's reason. */
  std::string
  read_text_file(const std::string &file_name);

  /** Writes a file as a whole or not at all: what is not whole yet is named
   * @p file_name + ".part". @throw FileError */
  void
  write_atomically(const std::string &text, const std::string &file_name);
} // namespace Crevasse

#endif
