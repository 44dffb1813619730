// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_automatic_h
#define crevasse_parameters_automatic_h

#include <crevasse/parameters/scene.h>

namespace Crevasse
{
  // Values of "automatic" parameters that the scene alone determines, as
  // doc/accuracy.md recommends.

  /** Automatic subdivisions of a built-in shape: squares with a side of a
   * seventh (in space of a quarter) of crack or ligament, but at most 64 (24)
   * cells in a direction. */
  std::vector<unsigned int>
  subdivisions(const GeometryParameters &geometry,
               const unsigned int        dimension);

  /** Value of [Discretisation] Singular functions, with the reason. */
  struct SingularFunctionChoice
  {
    unsigned int n;
    std::string  why;
  };

  /** Automatic number of singular functions: two at the tip of a built-in
   * crack, if nothing is against them. The scene must have passed its check. */
  SingularFunctionChoice
  singular_functions(const Scene &scene);

  /** A setting that forbids singular functions, such as "Dimension = 3", and
   * the reason or advice with the punctuation before it; empty: none. */
  struct SingularFunctionObstacle
  {
    std::string setting, advice;
  };

  /** First setting of a scene that forbids singular functions. */
  SingularFunctionObstacle
  obstacle_to_singular_functions(const Scene &scene);

  /** How often the cells at the tip of a built-in crack in the plane are
   * divided where K is computed without singular functions and the scene leaves
   * the mesh and the functions to the program; otherwise 0. */
  unsigned int
  automatic_cycles(const Scene &scene);

  /** Automatic [Output] Probes: one at the mouth of a built-in crack. */
  std::vector<NamedPoint>
  probes(const Scene &scene);
} // namespace Crevasse

#endif
