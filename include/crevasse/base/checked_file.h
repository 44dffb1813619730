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

  /** Of as much as can be read, and at most of the first @p bytes.
   * @throw FileError if it cannot be opened. */
  FileCheck
  check_file(const std::string &name,
             const std::size_t bytes = std::numeric_limits<std::size_t>::max());

  /** The checksum of some text. */
  std::uint32_t
  checksum(const std::string &text);

  /** Writes a file and makes sure that it is on the disk. @throw FileError */
  void
  write_file(const std::string &name, const std::string &content);

  /** Makes sure that names of files made or moved there, or what was written to
   * a file, survive a loss of power, where the file system is able to.
   * @throw FileError */
  void
  write_through(const std::string &name);

  /** Makes sure that the disk has room for a file of so many bytes, where the
   * file system can tell. The file is not left there.
   * @throw FileError */
  void
  require_disk_space(const std::string &name, const std::size_t bytes);
} // namespace Crevasse

#endif
