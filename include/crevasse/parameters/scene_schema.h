// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_scene_schema_h
#define crevasse_parameters_scene_schema_h

#include <crevasse/parameters/catalogue.h>

namespace Crevasse
{
  /** A JSON schema of .json scenes, with which editors complete and check them:
   * names, choices and ranges of numbers. Formulas and lists are texts there;
   * whether they can be read, the program alone knows. */
  Catalogue
  make_scene_schema(const Catalogue &catalogue);
} // namespace Crevasse

#endif
