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

#include <crevasse/output/directory_lock.h>
#include <crevasse/scene/problems.h>

#include <deal.II/base/utilities.h>

#include <cerrno>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <sys/file.h>
#include <unistd.h>

namespace Crevasse
{
  DirectoryLock::DirectoryLock(const std::string &directory)
    : name(directory + "/running")
    , file(open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666))
  {
    if (file < 0)
      return; // told when the run comes to write its files
    if (flock(file, LOCK_EX | LOCK_NB) == 0)
      {
        std::ofstream(name)
          << "process " << getpid() << " on "
          << dealii::Utilities::System::get_hostname() << '\n';
        return;
      }
    if (errno != EWOULDBLOCK)
      return; // there are no locks
    close(file);
    std::ifstream     other(name);
    const std::string who{std::istreambuf_iterator<char>(other), {}};
    throw FileError("Another run writes to " + directory + " (" +
                    who.substr(0, who.find('\n')) +
                    "). Choose another directory by --output DIR, or wait.");
  }



  DirectoryLock::~DirectoryLock()
  {
    if (file < 0)
      return;
    unlink(name.c_str());
    close(file);
  }
} // namespace Crevasse
