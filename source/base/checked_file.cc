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
    fail(const std::string &what)
    {
      throw FileError("Cannot " + what + " (" + std::strerror(errno) + ").");
    }
  } // namespace



  FileCheck
  check_file(const std::string &name, const std::size_t bytes)
  {
    std::ifstream file(name, std::ios::binary);
    if (!file)
      fail("read " + name);
    std::vector<char> part(1 << 20);
    FileCheck         check(0, 0);
    while (file.read(part.data(), std::min(part.size(), bytes - check.first)),
           file.gcount() > 0)
      {
        check.first += file.gcount();
        check.second = crc32_z(check.second,
                               reinterpret_cast<const Bytef *>(part.data()),
                               file.gcount());
      }
    return check;
  }



  std::uint32_t
  checksum(const std::string &text)
  {
    return crc32_z(0,
                   reinterpret_cast<const Bytef *>(text.data()),
                   text.size());
  }



  void
  write_file(const std::string &name, const std::string &content)
  {
    std::ofstream file(name, std::ios::binary);
    file << content;
    file.close();
    if (!file)
      fail("write " + name);
    write_through(name);
  }



  void
  write_through(const std::string &name)
  {
    const int descriptor = open(name.c_str(), O_RDONLY);
    if (descriptor < 0)
      fail("write " + name);
    // Some file systems cannot flush directories, and report that.
    const int error = fsync(descriptor) == 0 ? 0 : errno;
    close(descriptor);
    errno = error;
    if (error != 0 && error != EINVAL && error != ENOTSUP)
      fail("write " + name);
  }



  void
  require_disk_space(const std::string &name, const std::size_t bytes)
  {
    const int descriptor =
      open(name.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (descriptor < 0)
      fail("write " + name);
    const int error = fallocate(descriptor, 0, 0, bytes) == 0 ? 0 : errno;
    close(descriptor);
    unlink(name.c_str());
    errno = error;
    if (error != 0 && error != ENOSYS && error != ENOTSUP)
      fail("write " + std::to_string(bytes) + " bytes to " + name);
  }
} // namespace Crevasse
