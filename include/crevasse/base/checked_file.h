// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_checked_file_h
#define crevasse_base_checked_file_h

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

namespace Crevasse
{
  /** Size in bytes and checksum (CRC-32) of a file. */
  using FileCheck = std::pair<std::size_t, std::uint32_t>;

  /** Size and checksum of a file, at most of its first @p bytes.
   * @throw FileError if the file cannot be opened. */
  FileCheck
  check_file(const std::string &name,
             const std::size_t bytes = std::numeric_limits<std::size_t>::max());

  /** CRC-32 checksum of a text. */
  std::uint32_t
  checksum(const std::string &text);

  /** Writes a file and flushes it to the disk. @throw FileError */
  void
  write_file(const std::string &name, const std::string &content);

  /** Flushes a file, or a directory with names of new files, to the disk, to
   * survive a loss of power where the file system allows.
   * @throw FileError */
  void
  write_through(const std::string &name);

  /** Checks that the disk has room for a file of @p bytes, where the file
   * system can tell. The file is not left there.
   * @throw FileError */
  void
  require_disk_space(const std::string &name, const std::size_t bytes);
} // namespace Crevasse

#endif
