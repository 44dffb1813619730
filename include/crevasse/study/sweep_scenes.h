// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_study_sweep_scenes_h
#define crevasse_study_sweep_scenes_h

#include <crevasse/app/command_line.h>
#include <crevasse/base/directory_lock.h>
#include <crevasse/base/summary.h>
#include <crevasse/parameters/scene.h>
#include <crevasse/study/sweep_plan.h>

#include <deal.II/base/mpi.h>

#include <memory>
#include <string>
#include <vector>

namespace Crevasse
{
  /** One scene of a sweep. */
  struct SweepVariant
  {
    Scene       scene;
    std::string used;       ///< its used.prm
    Summary     parameters; ///< see scene_as_json()
  };

  /** Reads and checks a scene. @throw SceneError with all mistakes; FileError
   */
  SweepVariant
  read_variant(const std::string           &scene_file,
               const std::vector<Override> &overrides);

  /** Where a sweep keeps its runs: as on the command line, or beside the
   * results of the scene. */
  std::string
  directory_of_sweep(const Command &command, const Scene &scene);

  /** Makes it, and keeps other sweeps out of it as long as the lock exists,
   * which the first rank has. Collective. @throw FileError */
  std::unique_ptr<DirectoryLock>
  take_sweep_directory(const std::string &directory,
                       const MPI_Comm     communicator);

  /** All scenes of a sweep, which write no fields unless the command line says
   * so. */
  struct SweepScenes
  {
    SweepVariant              reference; ///< the scene itself without one
    std::vector<SweepVariant> points;

    /** Reads and checks them all. @throw SceneError with all mistakes of all
     * scenes, also if two points are the same; FileError */
    SweepScenes(const Command &command, const SweepPlan &plan);
  };
} // namespace Crevasse

#endif
