// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/postprocess/output_directory.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <system_error>

namespace Crevasse
{
  namespace fs = std::filesystem;

  namespace
  {
    [[noreturn]] void
    throw_error(const std::string &directory, const std::string &what)
    {
      throw FileError("[Output directory] " + directory + ": " + what +
                      ". Choose another one by --output DIR.");
    }
  } // namespace



  void
  require_writable_directory(const std::string &directory)
  {
    std::error_code error;
    fs::create_directories(directory, error);
    if (error)
      throw_error(directory, "cannot be created (" + error.message() + ")");

    const fs::path probe    = fs::path(directory) / ".write_test";
    const bool     writable = std::ofstream(probe).put('\n').good();
    fs::remove(probe, error);
    if (!writable)
      throw_error(directory, "cannot be written to");
  }



  namespace
  {
    /** Existing results of an earlier run besides used.prm, and reports about
     * them, which would not describe the new results.
     * @throw FileError if a directory is in the way, before the run starts. */
    std::vector<fs::path>
    results_in(const std::string &directory)
    {
      static const std::regex ours(
        "summary\\.json(\\.part)?|log\\.txt|solution\\.pvd|used\\.prm|"
        "solution_[0-9.]+\\.p?vtu|show_in_paraview\\.py|(probe_.*|contact|lip|"
        "periods|relaxation|load_work|(crack_tip|creep_integral)(_[0-9]+)?|"
        "crack_front)\\.csv|report\\.html");
      std::vector<fs::path> found;
      for (const fs::directory_entry &entry : fs::directory_iterator(directory))
        {
          const std::string name = entry.path().filename().string();
          if (name == "checkpoint")
            found.push_back(entry);
          if (!std::regex_match(name, ours))
            continue;
          if (entry.is_directory())
            throw_error(directory,
                        name +
                          " is a directory, but a file of this name is to "
                          "be written");
          if (name != "used.prm")
            found.push_back(entry);
        }
      return found;
    }



    /** Creates the first folder earlier_1, earlier_2, ... that does not exist,
     * with the parameters of the run whose results are moved there. */
    fs::path
    make_folder_for(const fs::path &used)
    {
      for (unsigned int number = 1;; ++number)
        {
          const fs::path folder =
            used.parent_path() / ("earlier_" + std::to_string(number));
          // The name may be taken by a folder, a file or a link, or another
          // process may be faster.
          if (fs::exists(fs::symlink_status(folder)) ||
              !fs::create_directory(folder))
            continue;
          fs::copy_file(used, folder / used.filename());
          return folder;
        }
    }
  } // namespace



  std::string
  clear_earlier_results(const std::string &directory, const EarlierResults fate)
  {
    try
      {
        const std::vector<fs::path> results = results_in(directory);
        // used.prm is written anew; while it exists, the other files belong to
        // an earlier run.
        const fs::path used = fs::path(directory) / "used.prm";
        if (!fs::is_regular_file(used))
          return "";
        const bool keep =
          fate == EarlierResults::are_kept &&
          std::any_of(results.begin(), results.end(), [](const fs::path &path) {
            return path.filename() != "log.txt";
          });
        const fs::path folder = keep ? make_folder_for(used) : fs::path();
        for (const fs::path &path : results)
          if (keep)
            fs::rename(path, folder / path.filename());
          else
            fs::remove_all(path);
        return folder.string();
      }
    catch (const fs::filesystem_error &error)
      {
        throw_error(
          directory,
          "the results of an earlier run cannot be moved or removed (" +
            error.code().message() + ")");
      }
  }
} // namespace Crevasse
