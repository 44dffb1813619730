// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_tensor_formulas_h
#define crevasse_parameters_tensor_formulas_h

#include <crevasse/base/expression.h>

#include <string>
#include <vector>

namespace Crevasse
{
  /** Reads the matrix of a stiffness or viscosity: rows separated by
   * semicolons, entries by commas.
   *
   * @param plane_stress in which the row 33 may be left out.
   * @param parameter "[Section] Name".
   * @return the formulas row by row.
   * @throw SceneError that tells what is expected. */
  std::vector<Expression>
  parse_matrix(const std::string &text,
               const unsigned int dimension,
               const bool         plane_stress,
               const std::string &parameter);

  /** Reads a number or the components of a symmetric tensor, separated by
   * commas.
   *
   * @throw SceneError that tells what is expected. */
  std::vector<Expression>
  parse_tensor(const std::string &text,
               const unsigned int dimension,
               const std::string &parameter);
} // namespace Crevasse

#endif
