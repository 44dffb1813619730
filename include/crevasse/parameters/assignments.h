// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_assignments_h
#define crevasse_parameters_assignments_h

#include <crevasse/base/problems.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace Crevasse
{
  /** One parameter as somebody set it, whether or not it exists. */
  struct Assignment
  {
    /** Where: "scene.prm:12", or the option of the command line. */
    std::string place;
    /** Names joined by "/" where sections are nested. */
    std::string section;
    /** Empty: the section is only opened here. */
    std::string name;
    std::string value;
  };

  /** Understands "Section/Name=value" of --set. */
  void
  read_override(const std::string       &text,
                std::vector<Assignment> &assignments,
                Problems                &problems);

  /** Sets each parameter in turn. What is unknown or has a value of the wrong
   * type is left as it was and reported with what would be allowed. */
  void
  apply(const std::vector<Assignment> &assignments,
        dealii::ParameterHandler      &prm,
        Problems                      &problems);
} // namespace Crevasse

#endif
