// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_scene_schema_h
#define crevasse_parameters_scene_schema_h

#include <crevasse/parameters/catalogue.h>

namespace Crevasse
{
  /** JSON schema of .json scenes, with which editors complete and check names,
   * choices and ranges of numbers. Formulas and lists are texts in the schema;
   * only the program checks them. */
  Catalogue
  make_scene_schema(const Catalogue &catalogue);
} // namespace Crevasse

#endif
