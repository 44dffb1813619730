// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_directory_lock_h
#define crevasse_base_directory_lock_h

#include <string>

namespace Crevasse
{
  /** Keeps other runs out of an output directory as long as it exists, by a
   * lock of the operating system on a file in it, which the end of the process
   * gives back however it comes. File systems without locks let everybody in.
   */
  class DirectoryLock
  {
  public:
    /** @throw FileError that names who writes there already. */
    explicit DirectoryLock(const std::string &directory);
    ~DirectoryLock();

    DirectoryLock(const DirectoryLock &) = delete;
    DirectoryLock &
    operator=(const DirectoryLock &) = delete;

  private:
    const std::string name;
    const int         file;
  };
} // namespace Crevasse

#endif
