// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/app/output_choice.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text_file.h>
#include <crevasse/checkpoint/checkpoint_folder.h>
#include <crevasse/checkpoint/scene_difference.h>
#include <crevasse/postprocess/output_directory.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <unistd.h>

namespace Crevasse
{
  namespace fs = std::filesystem;

  namespace
  {
    constexpr const char *name_in_scenes = "[Output directory] ";
    constexpr const char *option         = "--output ";



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
  } // namespace



  OutputChoice::OutputChoice(const Command &command, const Scene &scene)
    : from_command_line(!command.output_directory.empty())
    , may_replace(command.force)
    , path(from_command_line ? command.output_directory
           : !scene.output_directory.empty()
             ? scene.output_directory
             : "results/" + fs::path(command.scene_file).stem().string())
  {
  }



  void
  OutputChoice::require_usable() const
  {
    const fs::path  part = existing_part(path);
    std::error_code unknown;
    std::string     reason;
    if (!fs::is_directory(part, unknown))
      reason = "is not a directory";
    else if (access(part.c_str(), W_OK | X_OK) != 0)
      reason =
        std::string("cannot be written to (") + std::strerror(errno) + ")";
    if (!reason.empty())
      throw FileError((from_command_line ? option : name_in_scenes) + path +
                      ": results cannot be written there, because " +
                      part.string() + ' ' + reason +
                      ". Choose another one by --output DIR.");
  }



  void
  OutputChoice::require_nothing_to_resume(
    const std::string &used_parameters) const
  {
    const std::string earlier = path + "/used.prm";
    std::error_code   unknown;
    if (may_replace || !why_unreadable(earlier).empty() ||
        read_text_file(earlier) != used_parameters ||
        fs::exists(path + "/summary.json", unknown) ||
        !CheckpointFolder(path).has_any())
      return;
    throw SceneError(
      "A run of this scene was begun in " + path +
      " and has not ended. Resume it from its last checkpoint by --resume, "
      "choose another directory by --output DIR, or replace it by --force.");
  }



  std::string
  OutputChoice::why_finished(const Scene   &scene,
                             const Summary &parameters) const
  {
    const std::string name = path + "/summary.json";
    std::error_code   unknown;
    if (!fs::exists(name, unknown))
      return "";
    const Summary summary =
      Summary::parse(read_text_file(name), nullptr, false);
    try
      {
        // A summary that is no object is incomplete: the run has not ended.
        return summary.is_object() ? why_finished(summary, scene, parameters)
                                   : "";
      }
    catch (const Summary::exception &error)
      {
        throw FileError(
          "--resume: " + name + " is not a summary that a run writes (" +
          error.what() +
          "). Remove it: then the run resumes from its newest checkpoint.");
      }
  }



  std::string
  OutputChoice::why_finished(const Summary &summary,
                             const Scene   &scene,
                             const Summary &parameters) const
  {
    const unsigned int periods = summary.value("periods", 0U);
    if (periods == 0)
      return "";
    const unsigned int allowed   = scene.periodic_state.maximum_periods;
    const double       tolerance = scene.periodic_state.tolerance;
    const Summary      converged = summary.value("converged", Summary());
    const Summary     &estimates = summary.at("stress_error_estimate");
    const Summary      error = estimates.empty() ? Summary() : estimates.back();
    const bool         is_enough = converged == true && tolerance > 0. &&
                           error.is_number() && error <= tolerance;
    if (!is_enough && periods < allowed)
      return ""; // the checkpoint is checked instead
    if (!summary.contains("scene") || !summary["scene"].is_object())
      throw FileError(
        "--resume: the run in " + path +
        " has ended, but its summary.json does not hold the scene; another "
        "version of the program wrote it. Start without --resume, in another "
        "output directory.");
    require_same_scene(summary["scene"], parameters);
    return "the run in " + path + " has ended after " +
           std::to_string(periods) + (periods == 1 ? " period" : " periods") +
           (is_enough ? ", periodic."
            : CheckpointFolder(path).has_any()
              ? ", as many as [Periodic state] Maximum periods allows; raise "
                "it "
                "to continue."
              : ", as many as [Periodic state] Maximum periods allows, without "
                "a checkpoint to continue from; start again in another "
                "--output.");
  }



  std::unique_ptr<DirectoryLock>
  OutputChoice::resume() const
  {
    require_writable_directory(path);
    auto            lock = std::make_unique<DirectoryLock>(path);
    std::error_code error;
    fs::remove(path + "/summary.json", error);
    if (error)
      throw FileError("Cannot remove " + path + "/summary.json (" +
                      error.message() + ").");
    return lock;
  }



  std::unique_ptr<DirectoryLock>
  OutputChoice::prepare(std::string &kept) const
  {
    try
      {
        require_writable_directory(path);
        auto lock = std::make_unique<DirectoryLock>(path);
        kept      = clear_earlier_results(path,
                                     may_replace ? EarlierResults::are_removed
                                                      : EarlierResults::are_kept);
        return lock;
      }
    catch (const FileError &error)
      {
        // The thrower does not know whether the option chose the directory.
        std::string message = error.what();
        if (from_command_line && message.rfind(name_in_scenes, 0) == 0)
          message.replace(0, std::strlen(name_in_scenes), option);
        throw FileError(message);
      }
  }
} // namespace Crevasse
