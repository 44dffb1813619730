// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/directory_lock.h>
#include <crevasse/base/problems.h>

#include <deal.II/base/utilities.h>

#include <cerrno>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace Crevasse
{
  namespace
  {
    /** Whether the name still belongs to the open lock file: the previous run
     * may have removed it after it was opened here. */
    bool
    is_named(const int file, const std::string &name)
    {
      struct stat opened, named;
      return fstat(file, &opened) == 0 && stat(name.c_str(), &named) == 0 &&
             opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
    }



    /** Opens and locks the file "running"; -1 if it cannot be created: the run
     * reports this when it writes its files.
     * @throw FileError that names the run which writes to the directory. */
    int
    lock_file(const std::string &directory, const std::string &name)
    {
      // Some file systems give a file a new inode number each time.
      constexpr unsigned int most_tries = 10;
      for (unsigned int tries = 1;; ++tries)
        {
          const int file =
            open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
          if (file < 0)
            return file;
          if (flock(file, LOCK_EX | LOCK_NB) == 0)
            {
              if (tries == most_tries || is_named(file, name))
                return file;
              close(file);
              continue;
            }
          if (errno != EWOULDBLOCK)
            return file; // the file system has no locks
          close(file);
          std::ifstream     other(name);
          const std::string who{std::istreambuf_iterator<char>(other), {}};
          throw FileError("Another run writes to " + directory + " (" +
                          who.substr(0, who.find('\n')) +
                          "). Choose another directory by --output DIR, or "
                          "wait.");
        }
    }
  } // namespace



  DirectoryLock::DirectoryLock(const std::string &directory)
    : name(directory + "/running")
    , file(lock_file(directory, name))
  {
    if (file >= 0)
      std::ofstream(name) << "process " << getpid() << " on "
                          << dealii::Utilities::System::get_hostname() << '\n';
  }



  DirectoryLock::~DirectoryLock()
  {
    if (file < 0)
      return;
    unlink(name.c_str());
    close(file);
  }
} // namespace Crevasse
