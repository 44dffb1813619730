// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_checkpoint_scene_difference_h
#define crevasse_checkpoint_scene_difference_h

#include <crevasse/base/summary.h>

#include <deal.II/base/parameter_handler.h>

namespace Crevasse
{
  inline constexpr const char *checksums_of_files = "Content of files";

  /** All parameters of a scene, by section and name, and the checksums of the
   * files that they name. */
  Summary
  scene_as_json(const dealii::ParameterHandler &prm);

  /** Checks that a resumed run has the scene it was begun with, except for
   * parameters that leave the results so far unchanged.
   * @throw SceneError with all other differing parameters and their values. */
  void
  require_same_scene(const Summary &before, const Summary &now);
} // namespace Crevasse

#endif
