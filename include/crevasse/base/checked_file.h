// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_checked_file_h
#define crevasse_base_checked_file_h

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace Crevasse
{
  /** Size and checksum (CRC-32) of a file. */
  struct FileCheck
  {
    std::size_t   bytes = 0;
    std::uint32_t crc   = 0;

    /** For other ranks. */
    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &bytes &crc;
    }
  };

  /** A file that is on the disk once it was finished, and of which is known
   * what it contains. */
  class CheckedFile
  {
  public:
    /** @throw FileError if it cannot be made. */
    explicit CheckedFile(const std::string &name);

    ~CheckedFile();

    CheckedFile(const CheckedFile &) = delete;
    CheckedFile &
    operator=(const CheckedFile &) = delete;

    /** @throw FileError */
    void
    write(const void *data, const std::size_t bytes);

    /** Writes it through to the disk. @throw FileError */
    FileCheck
    finish();

  private:
    const std::string name;
    int               descriptor;
    FileCheck         check;
  };

  /** The whole file, or nothing and the reason why it is not what it was. */
  std::vector<char>
  read_checked(const std::string &name,
               const FileCheck   &expected,
               std::string       &fault);

  /** The checksum of some text. */
  std::uint32_t
  checksum(const std::string &text);

  /** Makes sure that names of files made or moved there, or what was written to
   * a file, survive a loss of power, where the file system is able to.
   * @throw FileError */
  void
  write_through(const std::string &name);
} // namespace Crevasse

#endif
