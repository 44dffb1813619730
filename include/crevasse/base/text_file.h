// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_text_file_h
#define crevasse_base_text_file_h

#include <string>

namespace Crevasse
{
  /** Why a file cannot be read, such as "cannot be read: it is a directory";
   * empty if it can be read. */
  std::string
  why_unreadable(const std::string &file_name);

  /** Reads the whole text of a file, without the byte order mark that some
   * editors write first.
   *
   * @throw FileError with the system's reason. */
  std::string
  read_text_file(const std::string &file_name);

  /** Writes a file as a whole or not at all: an incomplete file has the name
   * @p file_name + ".part". @throw FileError */
  void
  write_atomically(const std::string &text, const std::string &file_name);
} // namespace Crevasse

#endif
