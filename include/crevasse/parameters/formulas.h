// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_formulas_h
#define crevasse_parameters_formulas_h

#include <crevasse/base/expression.h>
#include <crevasse/base/parsed.h>
#include <crevasse/base/range.h>

namespace Crevasse
{
  // The parameters of a scene that are formulas, parsed once.

  using Formula  = Parsed<Expression>;
  using Formulas = Parsed<std::vector<Expression>>;
  /** Rows, each with its entries. */
  using FormulaMatrix = Parsed<std::vector<std::vector<Expression>>>;

  /** A Maxwell body of a chain: its part of the stiffness, and its relaxation
   * time. */
  struct ChainBranch
  {
    double     fraction;
    Expression relaxation_time;
  };

  // Parsers of parameters. Numbers must be in a range; whether the values of a
  // formula are is known when there are points.

  Formula::Parser
  material_formula(const std::string &name,
                   const Range       &range = Ranges::positive);

  /** A formula of t. */
  Formula::Parser
  time_factor(const std::string &name);

  /** A number, or the components of a symmetric tensor, separated by commas. */
  Formulas::Parser
  material_components(const std::string &name);

  /** Rows separated by semicolons, entries by commas. */
  FormulaMatrix::Parser
  material_matrix(const std::string &name);

  /** A formula for each direction, separated by semicolons. */
  Formulas::Parser
  load_components(const std::string &name);

  // These throw a SceneError that says what is expected.

  /** A formula of the place, with values of at most 0. */
  Expression
  parse_gap(const std::string &text);

  /** "fraction: time; fraction: time". */
  std::vector<ChainBranch>
  parse_chain(const std::string &text);

  /** A formula, or nothing for the name of a file. */
  std::optional<Expression>
  parse_temperature(const std::string &text);

  // Sizes that the dimension demands.

  /** @param plane_stress in which the row 33 may be left out. */
  void
  require_size(const FormulaMatrix &matrix,
               const unsigned int   dimension,
               const bool           plane_stress);

  /** Of a tensor. */
  void
  require_size(const Formulas &components, const unsigned int dimension);

  // What formulas depend on.

  /** The entries of a matrix row by row. */
  std::vector<Expression>
  entries(const FormulaMatrix &matrix);

  /** Whether all are the number 0. */
  bool
  are_zero(const std::vector<Expression> &formulas);

  bool
  depend_on(const std::string             &variable,
            const std::vector<Expression> &formulas);
} // namespace Crevasse

#endif
