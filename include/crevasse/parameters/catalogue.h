// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_catalogue_h
#define crevasse_parameters_catalogue_h

#include <deal.II/base/parameter_handler.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace Crevasse
{
  /** All parameters of a scene file in the order of declaration: an object for
   * each section, with "default_value", "documentation" and "allowed" for each
   * of its parameters, the last in words such as "one of: vtu, none"; the
   * section "" is the top level. */
  using Catalogue = nlohmann::ordered_json;

  /** Makes the catalogue from the printed entries of a ParameterHandler, which
   * gives their names and documentation in no other way. */
  Catalogue
  make_catalogue(const dealii::ParameterHandler &prm);

  /** Names of sections or parameters in a catalogue, without the top level. */
  std::vector<std::string>
  names_in(const Catalogue &object);

  /** JSON schema of .json scenes, with which editors complete and check names,
   * choices and ranges of numbers. Formulas and lists are texts in the schema;
   * only the program checks them. */
  Catalogue
  make_scene_schema(const Catalogue &catalogue);
} // namespace Crevasse

#endif
