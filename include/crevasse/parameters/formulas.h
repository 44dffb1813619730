// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_formulas_h
#define crevasse_parameters_formulas_h

#include <crevasse/base/expression.h>
#include <crevasse/base/parsed.h>
#include <crevasse/base/range.h>

namespace Crevasse
{
  // Types of parameters that are formulas, parsed once.

  using Formula  = Parsed<Expression>;
  using Formulas = Parsed<std::vector<Expression>>;
  /** Rows of a matrix of formulas. */
  using FormulaMatrix = Parsed<std::vector<std::vector<Expression>>>;

  /** A Maxwell body of a chain: its fraction of the stiffness, and its
   * relaxation time. */
  struct ChainBranch
  {
    double     fraction;
    Expression relaxation_time;
  };

  // Parsers of parameters. They check the range of numbers; values of formulas
  // are checked when points are known.

  Formula::Parser
  material_formula(const std::string &name,
                   const Range       &range = Ranges::positive);

  /** Parses a formula of t. */
  Formula::Parser
  time_factor(const std::string &name);

  /** Parses a number or components of a symmetric tensor, as "1, 2, 3, 4". */
  Formulas::Parser
  material_components(const std::string &name);

  /** Parses a matrix: rows separated by semicolons, entries by commas. */
  FormulaMatrix::Parser
  material_matrix(const std::string &name);

  /** Parses a formula for each direction, separated by semicolons. */
  Formulas::Parser
  load_components(const std::string &name);

  // The next parsers throw a SceneError that says what is expected.

  /** Parses the gap: a formula of the point, with values of at most 0. */
  Expression
  parse_gap(const std::string &text);

  /** Parses a chain: "fraction: time; fraction: time". */
  std::vector<ChainBranch>
  parse_chain(const std::string &text);

  /** Parses the temperature: a formula, or no value for the name of a file. */
  std::optional<Expression>
  parse_temperature(const std::string &text);

  // Checks of sizes against the dimension throw a SceneError.

  /** Checks the size of a matrix; in plane stress row 33 may be left out. */
  void
  require_size(const FormulaMatrix &matrix,
               const unsigned int   dimension,
               const bool           plane_stress);

  /** Checks the number of components of a symmetric tensor. */
  void
  require_size(const Formulas &components, const unsigned int dimension);

  // Dependences of formulas.

  /** Entries of a matrix of formulas, row by row. */
  std::vector<Expression>
  entries(const FormulaMatrix &matrix);

  /** Whether all formulas are the number 0. */
  bool
  are_zero(const std::vector<Expression> &formulas);

  bool
  depend_on(const std::string             &variable,
            const std::vector<Expression> &formulas);
} // namespace Crevasse

#endif
