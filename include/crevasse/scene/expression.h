// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#ifndef crevasse_scene_expression_h
#define crevasse_scene_expression_h

#include <deal.II/base/point.h>

#include <memory>
#include <set>
#include <string>
#include <vector>

namespace Crevasse
{
  /**
   * A formula of x, y, z and t as the user wrote it, evaluated by muParser.
   * Its used variables tell whether it depends on space or time, which decides
   * what is recomputed at each instant.
   */
  class Expression
  {
  public:
    /** @throw SceneError with muParser's own words if the formula does not
     * parse or uses an unknown name. */
    explicit Expression(const std::string &formula);
    ~Expression();
    Expression(Expression &&) noexcept;
    Expression &
    operator=(Expression &&) noexcept;

    /** @throw NumericalError naming formula, point and instant when the value
     * is not finite. */
    template <int dim>
    double
    value(const dealii::Point<dim> &point, const double t = 0.) const;

    bool
    depends_on_time() const;
    bool
    depends_on_space() const;
    /** Whether the formula is the number zero. */
    bool
    is_zero() const;

    const std::string &
    formula() const;

    /** Splits "a; b; c" at the semicolons and parses each part. */
    static std::vector<Expression>
    parse_list(const std::string &formulas);

  private:
    struct Parser; // keeps muParser.h out of every includer
    std::unique_ptr<Parser> parser;
    std::string             text;
    std::set<std::string>   variables;
  };
} // namespace Crevasse

#endif
