// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/postprocess/output_directory.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <system_error>
#include <vector>

namespace Crevasse
{
  namespace fs = std::filesystem;

  void
  require_writable_directory(const std::string &directory)
  {
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



  namespace
  {
    [[noreturn]] void
    throw_cannot_clear(const std::string     &directory,
                       const std::error_code &error)
    {
      throw FileError("[Output directory] " + directory +
                      ": the results of an earlier run cannot be cleared away "
                      "(" +
                      error.message() +
                      "). Choose another one by --output DIR.");
    }



    /** What a run writes besides used.prm, and the report of it, which would
     * tell of other results than those beside it; as far as it is there.
     * @throw FileError if a directory is in the way: told now, not when the run
     * comes to write it. */
    std::vector<fs::path>
    results_in(const std::string &directory)
    {
      static const std::regex ours(
        "summary\\.json(\\.part)?|log\\.txt|solution\\.pvd|used\\.prm|"
        "solution_[0-9.]+\\.p?vtu|(probe_.*|contact|periods|relaxation|"
        "load_work|crack_tip)\\.csv|report\\.html");
      std::vector<fs::path>  found;
      std::error_code        error;
      fs::directory_iterator entry(directory, error);
      for (; !error && entry != fs::directory_iterator();
           entry.increment(error))
        {
          const fs::path   &path = entry->path();
          const std::string name = path.filename().string();
          if (!std::regex_match(name, ours))
            continue;
          if (fs::is_directory(path, error))
            throw FileError("[Output directory] " + directory + ": " + name +
                            " is a directory, but a file of this name is to be "
                            "written. Remove it, or choose another output "
                            "directory by --output DIR.");
          if (name != "used.prm")
            found.push_back(path);
        }
      if (error)
        throw_cannot_clear(directory, error);
      if (fs::exists(fs::path(directory) / "checkpoint", error))
        found.push_back(fs::path(directory) / "checkpoint");
      return found;
    }



    /** The first of earlier_1, earlier_2, ... that is not there, now made, with
     * the parameters of the run whose results are to be kept there. */
    fs::path
    make_folder_for(const fs::path &used, std::error_code &error)
    {
      for (unsigned int number = 1;; ++number)
        {
          const fs::path folder =
            used.parent_path() / ("earlier_" + std::to_string(number));
          std::error_code not_there;
          if (fs::exists(fs::symlink_status(folder, not_there)))
            continue; // a folder, or a file or link of someone
          const bool made = fs::create_directory(folder, error);
          if (!made && !error)
            continue; // another process was faster
          if (made && !fs::copy_file(used, folder / used.filename(), error))
            fs::remove_all(folder, not_there); // nothing is kept in it
          return folder;
        }
    }
  } // namespace



  std::string
  clear_earlier_results(const std::string &directory, const EarlierResults fate)
  {
    const std::vector<fs::path> results = results_in(directory);
    // It is written anew; as long as it is there, what else is there can be
    // told to be an earlier run's.
    const fs::path  used = fs::path(directory) / "used.prm";
    std::error_code error;
    if (!fs::is_regular_file(used, error))
      return "";
    const bool keep =
      fate == EarlierResults::are_kept &&
      std::any_of(results.begin(), results.end(), [](const fs::path &path) {
        return path.filename() != "log.txt";
      });
    fs::path folder;
    error.clear();
    if (keep)
      folder = make_folder_for(used, error);
    for (const fs::path &path : results)
      if (!error && keep)
        fs::rename(path, folder / path.filename(), error);
      else if (!error)
        fs::remove_all(path, error);
    if (error)
      throw_cannot_clear(directory, error);
    return folder.string();
  }
} // namespace Crevasse
