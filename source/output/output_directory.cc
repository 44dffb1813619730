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

#include <crevasse/output/output_directory.h>
#include <crevasse/scene/problems.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <system_error>

namespace Crevasse
{
  void
  require_writable_directory(const std::string &directory)
  {
    namespace fs = std::filesystem;
    std::error_code error;
    fs::create_directories(directory, error);
    if (error)
      throw FileError("[Output directory] " + directory +
                      ": cannot be created (" + error.message() +
                      "). Choose another one by --output DIR.");

    const fs::path probe    = fs::path(directory) / ".write_test";
    const bool     writable = std::ofstream(probe).put('\n').good();
    fs::remove(probe, error);
    if (!writable)
      throw FileError("[Output directory] " + directory +
                      ": cannot be written to. Choose another one by --output "
                      "DIR.");
  }



  void
  remove_earlier_results(const std::string &directory)
  {
    namespace fs = std::filesystem;
    // What is in the way is told now, not when the run comes to write it.
    static const std::regex ours(
      "summary\\.json(\\.part)?|used\\.prm|log\\.txt|solution\\.pvd|"
      "solution_[0-9.]+\\.p?vtu|(probe_.*|contact|periods|relaxation|load_work|"
      "crack_tip)"
      "\\.csv|"
      "contact_problem_[0-9_]+([a-z_]+\\.mtx|\\.petsc|\\.petsc\\.info)");
    const fs::path         used = fs::path(directory) / "used.prm";
    std::error_code        error;
    const bool             earlier_run = fs::is_regular_file(used, error);
    fs::directory_iterator entry(directory, error);
    for (; !error && entry != fs::directory_iterator(); entry.increment(error))
      {
        const fs::path &path = entry->path();
        if (!std::regex_match(path.filename().string(), ours))
          continue;
        if (fs::is_directory(path, error))
          throw FileError("[Output directory] " + directory + ": " +
                          path.filename().string() +
                          " is a directory, but a file of this name is to be "
                          "written. Remove it, or choose another output "
                          "directory by --output DIR.");
        // used.prm is written anew; as long as it is there, what else is
        // there can be told to be an earlier run's.
        if (!error && earlier_run && path != used)
          fs::remove(path, error);
        if (error)
          break;
      }
    if (!error && earlier_run)
      fs::remove_all(fs::path(directory) / "checkpoint", error);
    if (error)
      throw FileError("[Output directory] " + directory +
                      ": the results of an earlier run cannot be removed (" +
                      error.message() +
                      "). Choose another one by --output DIR.");
  }
} // namespace Crevasse
