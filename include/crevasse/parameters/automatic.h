// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_automatic_h
#define crevasse_parameters_automatic_h

#include <crevasse/parameters/scene.h>

namespace Crevasse
{
  // What parameters that a scene leaves "automatic" are, where the scene alone
  // decides that: as doc/accuracy.md recommends.

  /** Numbers of cells of a built-in shape: squares of a seventh (in space of a
   * quarter) of crack or ligament, but no more than 64 (24) cells in a
   * direction. */
  std::vector<unsigned int>
  subdivisions(const GeometryParameters &geometry,
               const unsigned int        dimension);

  /** [Discretisation] Singular functions. */
  struct SingularFunctionChoice
  {
    unsigned int n;
    std::string  why;
  };

  /** Two at the tip of a built-in crack, if nothing is against them. The scene
   * must have passed its check. */
  SingularFunctionChoice
  singular_functions(const Scene &scene);

  /** A setting that allows no singular functions, "Dimension = 3", and why not
   * or what to do, with the punctuation before it; empty: there is none. */
  struct SingularFunctionObstacle
  {
    std::string setting, advice;
  };

  /** The first one. */
  SingularFunctionObstacle
  obstacle_to_singular_functions(const Scene &scene);

  /** [Output] Probes: one at the mouth of a built-in crack. */
  std::vector<NamedPoint>
  probes(const Scene &scene);
} // namespace Crevasse

#endif
