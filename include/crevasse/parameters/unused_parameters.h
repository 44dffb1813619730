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
