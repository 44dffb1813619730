// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_scene_file_h
#define crevasse_parameters_scene_file_h

#include <crevasse/parameters/assignments.h>
#include <crevasse/parameters/scene.h>

#include <ostream>

namespace Crevasse
{
  /** Writes all parameters with defaults and documentation in a format: "prm",
   * "json", "markdown", or "schema" (a JSON schema). */
  void
  print_parameters(std::ostream &out, const std::string &format);

  /**
   * Reads a .prm or .json scene, then the overrides "Section/Name=value" of the
   * command line. Syntax errors and unknown parameters are added to @p problems
   * with file, line, section, parameter, value and allowed values; reading
   * continues. Values are not yet checked against each other: call
   * Scene::check(). The mesh file is first sought next to the scene.
   *
   * @p prm must be new. It can then write used.prm; nothing must be set or read
   * through it afterwards, for its entries refer to the scene that was filled
   * here, not to the one that is returned.
   *
   * @throw FileError if the file cannot be read.
   */
  Scene
  read_scene(const std::string              &file_name,
             const std::vector<std::string> &overrides,
             dealii::ParameterHandler       &prm,
             Problems                       &problems);

  /** Text of used.prm: every parameter of the scene that @p prm has read. */
  std::string
  used_parameters(dealii::ParameterHandler &prm);
} // namespace Crevasse

#endif
