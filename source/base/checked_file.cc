// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/checked_file.h>
#include <crevasse/base/problems.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <unistd.h>
#include <zlib.h>

namespace Crevasse
{
  namespace
  {
    [[noreturn]] void
    fail(const std::string &name)
    {
      throw FileError("Cannot write " + name + " (" + std::strerror(errno) +
                      ").");
    }



    std::uint32_t
    add_to_checksum(const std::uint32_t crc,
                    const void         *data,
                    const std::size_t   bytes)
    {
      return crc32_z(crc, static_cast<const Bytef *>(data), bytes);
    }
  } // namespace



  CheckedFile::CheckedFile(const std::string &name)
    : name(name)
    , descriptor(open(name.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666))
  {
    if (descriptor < 0)
      fail(name);
  }



  CheckedFile::~CheckedFile()
  {
    if (descriptor >= 0)
      close(descriptor);
  }



  void
  CheckedFile::write(const void *data, const std::size_t bytes)
  {
    const char *next = static_cast<const char *>(data);
    for (std::size_t left = bytes; left > 0;)
      {
        const ssize_t written = ::write(descriptor, next, left);
        if (written < 0 && errno == EINTR)
          continue;
        if (written < 0)
          fail(name);
        next += written;
        left -= written;
      }
    check.bytes += bytes;
    check.crc = add_to_checksum(check.crc, data, bytes);
  }



  FileCheck
  CheckedFile::finish()
  {
    if (fsync(descriptor) != 0)
      fail(name);
    close(descriptor);
    descriptor = -1;
    return check;
  }



  std::vector<char>
  read_checked(const std::string &name,
               const FileCheck   &expected,
               std::string       &fault)
  {
    std::ifstream file(name, std::ios::binary | std::ios::ate);
    if (!file)
      {
        fault = name + " is missing";
        return {};
      }
    const std::size_t bytes = file.tellg();
    if (bytes != expected.bytes)
      {
        fault = name + " has " + std::to_string(bytes) + " bytes instead of " +
                std::to_string(expected.bytes);
        return {};
      }
    std::vector<char> content(bytes);
    file.seekg(0);
    if (bytes > 0 && !file.read(content.data(), bytes))
      fault = name + " cannot be read";
    else if (add_to_checksum(0, content.data(), bytes) != expected.crc)
      fault = name + " has another checksum";
    return fault.empty() ? content : std::vector<char>();
  }



  std::uint32_t
  checksum(const std::string &text)
  {
    return add_to_checksum(0, text.data(), text.size());
  }



  void
  write_through(const std::string &name)
  {
    const int descriptor = open(name.c_str(), O_RDONLY);
    if (descriptor < 0)
      fail(name);
    // Some file systems cannot do it for directories, and say so.
    const int error = fsync(descriptor) == 0 ? 0 : errno;
    close(descriptor);
    errno = error;
    if (error != 0 && error != EINVAL && error != ENOTSUP)
      fail(name);
  }
} // namespace Crevasse
