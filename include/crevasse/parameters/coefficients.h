// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_coefficients_h
#define crevasse_parameters_coefficients_h

#include <crevasse/base/expression.h>
#include <crevasse/parameters/parameters.h>

#include <string>
#include <utility>
#include <vector>

namespace Crevasse
{
  // Which formulas make the material of a scene.

  /** Parameters of the section Material by name, with their formulas. */
  using Formulas = std::vector<std::pair<const char *, std::string>>;

  /** The coefficients of the stiffness, without its factor. */
  Formulas
  stiffness_formulas(const MaterialParameters &material);

  /** Those of the viscosity, likewise. */
  Formulas
  viscosity_formulas(const MaterialParameters &material);

  /** A number or formula, or those of a matrix or tensor. */
  std::vector<Expression>
  parse_coefficients(const std::string &formulas);

  /** Whether all of some formulas are the number 0. */
  bool
  are_zero(const std::vector<Expression> &formulas);

  /** Whether the temperature causes strain, where there is one. */
  bool
  expands(const MaterialParameters &material);

  /** Whether there is a change of temperature. */
  bool
  is_warm(const LoadParameters &loads);
} // namespace Crevasse

#endif
