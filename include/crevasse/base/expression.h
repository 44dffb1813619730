// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_expression_h
#define crevasse_base_expression_h

#include <deal.II/base/point.h>

#include <memory>
#include <set>
#include <string>
#include <vector>

namespace Crevasse
{
  /** Where and when a formula is evaluated. */
  template <int dim>
  struct Place
  {
    dealii::Point<dim> point;
    double             t           = 0.;
    double             temperature = 0.; ///< theta, a change of temperature
    unsigned int       material    = 0;  ///< the material id of the cell
  };

  /**
   * A formula as the user wrote it, evaluated by muParser. Its used variables
   * say whether it depends on space or time, which decides what is recomputed
   * at each instant. Copies share the parser, and so must not be evaluated in
   * several threads at once.
   */
  class Expression
  {
  public:
    /** What a formula may depend on. Only the properties of the material know
     * theta and material. */
    struct Variables
    {
      static constexpr const char *time           = "t";
      static constexpr const char *space          = "x, y, z";
      static constexpr const char *space_and_time = "x, y, z, t";
      static constexpr const char *space_time_and_material =
        "x, y, z, t, theta, material";
    };

    /** @param parameter that the formula was given for, "[Section] Name".
     * @throw SceneError with muParser's own words if the formula does not
     * parse or uses an unknown name. */
    explicit Expression(const std::string &formula,
                        const std::string &allowed = Variables::space_and_time,
                        const std::string &parameter = "");

    /** @throw SceneError naming parameter, formula, point and instant when the
     * value is not finite: whoever evaluates a formula during a run looks at
     * all its points and instants before. */
    template <int dim>
    double
    value(const Place<dim> &place) const;

    template <int dim>
    double
    value(const dealii::Point<dim> &point, const double t = 0.) const;

    bool
    depends_on(const std::string &variable) const
    {
      return variables.count(variable) > 0;
    }

    bool
    depends_on_time() const
    {
      return depends_on("t");
    }
    bool
    depends_on_space() const
    {
      return depends_on("x") || depends_on("y") || depends_on("z");
    }
    /** Whether the formula is a number. */
    bool
    is_constant() const
    {
      return variables.empty();
    }
    /** Whether the formula is the number zero. */
    bool
    is_zero() const;

    /** Whether the value can jump where the variable passes some value: whether
     * a condition depends on it, or the argument of sign, rint, floor or ceil.
     */
    bool
    can_jump_with(const std::string &variable) const;

    const std::string &
    formula() const
    {
      return text;
    }

    /** "[Section] Name", or nothing. */
    const std::string &
    parameter() const
    {
      return name;
    }

    /** Splits "a; b; c" at the separators that are not within brackets, and
     * parses each part; nothing gives none. */
    static std::vector<Expression>
    parse_list(const std::string &formulas,
               const char         separator,
               const std::string &variables = Variables::space_and_time,
               const std::string &parameter = "");

  private:
    struct Parser; // keeps muParser.h out of every includer
    std::shared_ptr<Parser> parser;
    std::string             text;
    std::string             name; ///< of the parameter
    std::set<std::string>   variables;
  };
} // namespace Crevasse

#endif
