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

#ifndef crevasse_run_sweep_scenes_h
#define crevasse_run_sweep_scenes_h

#include <crevasse/run/command_line.h>
#include <crevasse/run/sweep_plan.h>
#include <crevasse/scene/scene.h>

#include <string>
#include <vector>

namespace Crevasse
{
  /** One scene of a sweep. */
  struct SweepVariant
  {
    Scene       scene;
    std::string used; ///< its used.prm
  };

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
