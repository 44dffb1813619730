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
  /** What a scene file may contain: an object for each section, which has for
   * each of its parameters "default_value", "documentation" and what is
   * "allowed", in words such as "one of: vtu, none"; the sections "" is the top
   * level. In the order in which they were declared. */
  using Catalogue = nlohmann::ordered_json;

  /** Reads it off a ParameterHandler, which tells the names and the
   * documentation of its entries only by printing them. */
  Catalogue
  make_catalogue(const dealii::ParameterHandler &prm);

  /** Of deal.II's description of a pattern, or NumberPattern's, such as
   * "[Integer range 0...9 (inclusive)]": "Integer", "0", "9", "inclusive". One
   * of another form is the only part. */
  std::vector<std::string>
  parts_of_pattern(const std::string &description);

  /** The names of sections or parameters, without the top level. */
  std::vector<std::string>
  names_in(const Catalogue &object);
} // namespace Crevasse

#endif
