// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/app/output_choice.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text_file.h>
#include <crevasse/checkpoint/checkpoint_folder.h>
#include <crevasse/checkpoint/scene_difference.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <regex>
#include <unistd.h>

namespace Crevasse
{
  namespace fs = std::filesystem;

  namespace
  {
    /** The existing part of a path. */
    fs::path
    existing_part(const std::string &path)
    {
      fs::path        part = fs::absolute(path).lexically_normal();
      std::error_code unknown;
      while (!fs::exists(part, unknown) && part.has_relative_path())
        part = part.parent_path();
      return part;
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



  OutputChoice::OutputChoice(const Command &command, const Scene &scene)
    : directory(!command.output_directory.empty() ? command.output_directory
                : !scene.output_directory.empty()
                  ? scene.output_directory
                  : "results/" + fs::path(command.scene_file).stem().string())
    , from_command_line(!command.output_directory.empty())
    , may_replace(command.force)
  {
  }



  void
  OutputChoice::fail(const std::string &what) const
  {
    throw FileError((from_command_line ? "--output " : "[Output directory] ") +
                    directory + ": " + what +
                    ". Choose another one by --output DIR.");
  }



  void
  OutputChoice::require_usable() const
  {
    const fs::path    part = existing_part(directory);
    const std::string beginning =
      "results cannot be written there, because " + part.string();
    std::error_code unknown;
    if (!fs::is_directory(part, unknown))
      fail(beginning + " is not a directory");
    if (access(part.c_str(), W_OK | X_OK) != 0)
      fail(beginning + " cannot be written to (" + std::strerror(errno) + ")");
  }



  void
  OutputChoice::require_writable() const
  {
    std::error_code error;
    fs::create_directories(directory, error);
    if (error)
      fail("cannot be created (" + error.message() + ")");
    const fs::path probe    = fs::path(directory) / ".write_test";
    const bool     writable = std::ofstream(probe).put('\n').good();
    fs::remove(probe, error);
    if (!writable)
      fail("cannot be written to");
  }



  void
  OutputChoice::require_nothing_to_resume(
    const std::string &used_parameters) const
  {
    const std::string earlier = directory + "/used.prm";
    std::error_code   unknown;
    if (may_replace || !why_unreadable(earlier).empty() ||
        read_text_file(earlier) != used_parameters ||
        fs::exists(directory + "/summary.json", unknown) ||
        !CheckpointFolder(directory).has_any())
      return;
    throw SceneError(
      "A run of this scene was begun in " + directory +
      " and has not ended. Resume it from its last checkpoint by --resume, "
      "choose another directory by --output DIR, or replace it by --force.");
  }



  std::string
  OutputChoice::why_finished(const Scene   &scene,
                             const Summary &parameters) const
  {
    const std::string name = directory + "/summary.json";
    std::error_code   unknown;
    if (!fs::exists(name, unknown))
      return "";
    const Summary summary =
      Summary::parse(read_text_file(name), nullptr, false);
    if (!summary.is_object())
      return ""; // incomplete: the run has not ended
    try
      {
        const unsigned int periods = summary.value("periods", 0U);
        if (periods == 0)
          return "";
        const unsigned int allowed   = scene.periodic_state.maximum_periods;
        const double       tolerance = scene.periodic_state.tolerance;
        const Summary      converged = summary.value("converged", Summary());
        const Summary     &estimates = summary.at("stress_error_estimate");
        const Summary error = estimates.empty() ? Summary() : estimates.back();
        const bool    is_enough = converged == true && tolerance > 0. &&
                               error.is_number() && error <= tolerance;
        if (!is_enough && periods < allowed)
          return ""; // the checkpoint is checked instead
        if (!summary.contains("scene") || !summary["scene"].is_object())
          throw FileError(
            "--resume: the run in " + directory +
            " has ended, but its summary.json does not hold the scene; another "
            "version of the program wrote it. Start without --resume, in "
            "another output directory.");
        require_same_scene(summary["scene"], parameters);
        return "the run in " + directory + " has ended after " +
               std::to_string(periods) +
               (periods == 1 ? " period" : " periods") +
               (is_enough ? ", periodic."
                : CheckpointFolder(directory).has_any()
                  ? ", as many as [Periodic state] Maximum periods allows; "
                    "raise it to continue."
                  : ", as many as [Periodic state] Maximum periods allows, "
                    "without a checkpoint to continue from; start again in "
                    "another --output.");
      }
    catch (const Summary::exception &error)
      {
        throw FileError(
          "--resume: " + name + " is not a summary that a run writes (" +
          error.what() +
          "). Remove it: then the run resumes from its newest checkpoint.");
      }
  }



  std::unique_ptr<DirectoryLock>
  OutputChoice::resume(const std::string &used,
                       const Checkpoints &checkpoints) const
  {
    const CheckpointManifest &manifest = checkpoints.last_manifest();
    checkpoints.folder.require_tables(manifest);
    require_writable();
    auto            lock = std::make_unique<DirectoryLock>(directory);
    std::error_code error;
    fs::remove(directory + "/summary.json", error);
    if (error)
      throw FileError("Cannot remove " + directory + "/summary.json (" +
                      error.message() + ").");
    checkpoints.folder.go_back_to(manifest);
    write_atomically(used, directory + "/used.prm");
    return lock;
  }



  std::unique_ptr<DirectoryLock>
  OutputChoice::prepare(const std::string &used, Log &log) const
  {
    require_writable();
    auto        lock = std::make_unique<DirectoryLock>(directory);
    std::string kept;
    try
      {
        kept = clear_earlier_results();
      }
    catch (const fs::filesystem_error &error)
      {
        fail("the results of an earlier run cannot be moved or removed (" +
             error.code().message() + ")");
      }
    if (!kept.empty())
      log.line("  results of an earlier run are kept in " + kept);
    write_atomically(used, directory + "/used.prm");
    return lock;
  }



  std::string
  OutputChoice::clear_earlier_results() const
  {
    static const std::regex ours(
      "summary\\.json(\\.part)?|log\\.txt|solution\\.pvd|used\\.prm|"
      "solution_[0-9.]+\\.p?vtu|show_in_paraview\\.py|(probe_.*|contact|lip|"
      "periods|missions|relaxation|load_work|(crack_tip|creep_integral)(_[0-9]+"
      ")?|"
      "crack_front)\\.csv|report\\.html");
    std::vector<fs::path> results;
    for (const fs::directory_entry &entry : fs::directory_iterator(directory))
      {
        const std::string name = entry.path().filename().string();
        if (name == "checkpoint")
          results.push_back(entry);
        if (!std::regex_match(name, ours))
          continue;
        if (entry.is_directory())
          fail(name +
               " is a directory, but a file of this name is to be written");
        if (name != "used.prm")
          results.push_back(entry);
      }
    // used.prm is written anew; while it exists, the other files belong to an
    // earlier run.
    const fs::path used = fs::path(directory) / "used.prm";
    if (!fs::is_regular_file(used))
      return "";
    const bool keep =
      !may_replace &&
      std::any_of(results.begin(), results.end(), [](const fs::path &path) {
        return path.filename() != "log.txt";
      });
    const fs::path folder = keep ? make_folder_for(used) : fs::path();
    for (const fs::path &result : results)
      if (keep)
        fs::rename(result, folder / result.filename());
      else
        fs::remove_all(result);
    return folder.string();
  }
} // namespace Crevasse
