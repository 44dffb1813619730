// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_catalogue_h
#define crevasse_parameters_catalogue_h

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace Crevasse
{
  /** What a scene file may contain, read off a ParameterHandler: deal.II tells
   * the names and the documentation of its entries only by printing them. */
  struct Catalogue
  {
    struct Parameter
    {
      std::string name;
      std::string default_value;
      std::string meaning;
      /** In words, such as "one of: vtu, none". */
      std::string allowed;
      /** The same as far as the type of the value goes, ranges aside. */
      std::string type;
    };

    struct Section
    {
      /** Empty: the top level of the file. */
      std::string            name;
      std::vector<Parameter> parameters;

      /** The parameter of this name, or nullptr. */
      const Parameter *
      find(const std::string &name) const;

      std::vector<std::string>
      names() const;
    };

    explicit Catalogue(const dealii::ParameterHandler &prm);

    /** The section of this name, or nullptr. */
    const Section *
    find(const std::string &name) const;

    /** The names of the sections, without the top level. */
    std::vector<std::string>
    names() const;

    /** In the order in which they were declared, the top level first. */
    std::vector<Section> sections;
  };
} // namespace Crevasse

#endif
