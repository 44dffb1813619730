// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_unused_parameters_h
#define crevasse_parameters_unused_parameters_h

#include <crevasse/parameters/scene.h>

#include <string>
#include <vector>

namespace Crevasse
{
  /** The parameters that have another value than their default, but cannot
   * have an effect beside the others of their scene: a sentence for each, with
   * the reason. The scene must have passed its check. */
  std::vector<std::string>
  unused_parameters(const Scene &scene);
} // namespace Crevasse

#endif
