// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_directory_lock_h
#define crevasse_base_directory_lock_h

#include <string>

namespace Crevasse
{
  /** Keeps other runs out of an output directory during its life, by a lock of
   * the operating system on a file in the directory. The system releases the
   * lock when the process ends in any way. File systems without locks exclude
   * nobody. */
  class DirectoryLock
  {
  public:
    /** @throw FileError that names the run which writes to the directory. */
    explicit DirectoryLock(const std::string &directory);
    ~DirectoryLock();

    DirectoryLock(const DirectoryLock &) = delete;

  private:
    const std::string name;
    const int         file;
  };
} // namespace Crevasse

#endif
