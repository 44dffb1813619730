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

  /** Parsers of parameters that are formulas, which may call functions of
   * tables. They check the range of numbers; values of formulas are checked
   * when points are known. */
  struct FormulaParsers
  {
    /** Read before the formulas. */
    Tables tables;

    Formula::Parser
    material_formula(const std::string &name,
                     const Range       &range = Ranges::positive) const;

    /** Parses a formula of t. */
    Formula::Parser
    time_factor(const std::string &name) const;

    /** Parses a number or components of a symmetric tensor, as "1, 2, 3, 4". */
    Formulas::Parser
    material_components(const std::string &name) const;

    /** Parses a matrix: rows separated by semicolons, entries by commas. */
    FormulaMatrix::Parser
    material_matrix(const std::string &name) const;

    /** Parses a formula for each direction, separated by semicolons. */
    Formulas::Parser
    load_components(const std::string &name) const;

    /** Parses a constant of a growth law: a formula of theta. */
    Formula::Parser
    growth_constant(const std::string &name, const Range &range) const;

    /** Parses the gap: a formula of the point, with values of at most 0. */
    Formula::Parser
    gap_formula() const;

    /** Parses a coefficient of friction: a formula of point, instant and
     * temperature, with values of at least 0; a list of one. */
    Formulas::Parser
    friction_coefficient() const;

    /** Parses a chain: "fraction: time; fraction: time". */
    std::function<std::vector<ChainBranch>(const std::string &)>
    chain_parser() const;

    /** Parses the temperature: a formula, or no value for the name of a file.
     */
    Parsed<std::optional<Expression>>::Parser
    temperature_formula() const;
  };

  /** Parses a number; an empty text gives no value. @throw SceneError */
  std::optional<double>
  parse_optional_number(const std::string &text);

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
