// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/checkpoint/scene_difference.h>
#include <crevasse/parameters/scene_file.h>
#include <crevasse/postprocess/output_directory.h>
#include <crevasse/study/sweep_scenes.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>

namespace Crevasse
{
  namespace
  {
    /** Everything that is wrong with some scenes that share most of their
     * mistakes, each told once. */
    class Mistakes
    {
    public:
      void
      collect(const std::function<void()> &read)
      {
        try
          {
            read();
          }
        catch (const SceneError &error)
          {
            add(error.what());
          }
      }

      void
      throw_if_any() const
      {
        if (!lines.empty())
          throw SceneError((lines.size() == 1
                              ? ""
                              : std::to_string(lines.size()) + " problems:\n") +
                           Text::join(lines, "\n"));
      }

    private:
      void
      add(const std::string &message)
      {
        // What Problems says of more than one begins with their number.
        const std::string several = " problems:\n";
        const std::size_t end     = message.find(several);
        const std::size_t begin =
          end == std::string::npos ? 0 : end + several.size();
        for (const auto &line : Text::split(message.substr(begin), '\n'))
          if (std::find(lines.begin(), lines.end(), line) == lines.end())
            lines.push_back(line);
      }

      std::vector<std::string> lines;
    };



    void
    refuse_equal_points(const std::vector<SweepVariant> &points,
                        const SweepPlan                 &plan)
    {
      std::map<std::string, std::size_t> known;
      for (std::size_t p = 0; p < points.size(); ++p)
        if (!known.emplace(points[p].used, p).second)
          throw SceneError("--vary: there are several points with " +
                           Text::join(plan.points()[p].values, ", ") +
                           "; each value may be listed once");
    }



    /** The scene of the command line with what the sweep sets itself. */
    SweepVariant
    read_point(const Command &command, const std::vector<Override> &own)
    {
      // Fields of many points fill disks; whoever wants them says so.
      std::vector<Override> overrides = {{"Output/Fields=none", "sweep"}};
      overrides.insert(overrides.end(),
                       command.overrides.begin(),
                       command.overrides.end());
      overrides.insert(overrides.end(), own.begin(), own.end());
      return read_variant(command.scene_file, overrides);
    }
  } // namespace



  SweepVariant
  read_variant(const std::string           &scene_file,
               const std::vector<Override> &overrides)
  {
    dealii::ParameterHandler prm;
    Problems                 problems;
    SweepVariant             variant;
    variant.scene = read_scene(scene_file, overrides, prm, problems);
    variant.scene.check(problems);
    problems.throw_if_any();
    variant.used       = used_parameters(prm);
    variant.parameters = scene_as_json(prm);
    return variant;
  }



  std::string
  directory_of_sweep(const Command &command, const Scene &scene)
  {
    if (!command.output_directory.empty())
      return command.output_directory;
    return (!scene.output_directory.empty()
              ? scene.output_directory
              : "results/" +
                  std::filesystem::path(command.scene_file).stem().string()) +
           "_sweep";
  }



  std::unique_ptr<DirectoryLock>
  take_sweep_directory(const std::string &directory,
                       const MPI_Comm     communicator)
  {
    std::unique_ptr<DirectoryLock> lock;
    collectively(communicator, [&]() {
      if (dealii::Utilities::MPI::this_mpi_process(communicator) != 0)
        return;
      require_writable_directory(directory);
      lock = std::make_unique<DirectoryLock>(directory);
    });
    return lock;
  }



  SweepScenes::SweepScenes(const Command &command, const SweepPlan &plan)
    : points(plan.points().size())
  {
    Mistakes              mistakes;
    std::vector<Override> own;
    for (const std::string &text : command.sweep_request.reference)
      own.push_back({text, "--reference"});
    mistakes.collect([&]() { reference = read_point(command, own); });
    for (std::size_t p = 0; p < points.size(); ++p)
      mistakes.collect([&]() {
        points[p] = read_point(command, plan.overrides(plan.points()[p]));
      });
    mistakes.throw_if_any();
    refuse_equal_points(points, plan);
  }
} // namespace Crevasse
