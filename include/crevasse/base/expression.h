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
  /** Point, time, temperature and material where a formula is evaluated. */
  template <int dim>
  struct Place
  {
    dealii::Point<dim> point;
    double             t           = 0.;
    double             temperature = 0.; ///< theta, the change of temperature
    unsigned int       material    = 0;  ///< the material id of the cell
  };

  /**
   * A formula as the user wrote it, evaluated by muParser. The variables in it
   * show whether it depends on space or time, which decides what is recomputed
   * at each instant. Copies share the parser, and so must not be evaluated in
   * several threads at once.
   */
  class Expression
  {
  public:
    /** Variables that a formula may use. Only material properties know theta
     * and material. */
    struct Variables
    {
      static constexpr const char *time           = "t";
      static constexpr const char *space          = "x, y, z";
      static constexpr const char *space_and_time = "x, y, z, t";
      static constexpr const char *space_time_and_material =
        "x, y, z, t, theta, material";
    };

    /** @param parameter Parameter with this formula, "[Section] Name".
     * @throw SceneError with the message of muParser if the formula does not
     * parse or uses an unknown name. */
    explicit Expression(const std::string &formula,
                        const std::string &allowed = Variables::space_and_time,
                        const std::string &parameter = "");

    /** Value of the formula.
     * @throw SceneError naming parameter, formula, point and instant when the
     * value is not finite. Check all points and instants before a run. */
    template <int dim>
    double
    value(const Place<dim> &place) const;

    template <int dim>
    double
    value(const dealii::Point<dim> &point, const double t = 0.) const
    {
      return value(Place<dim>{point, t});
    }

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

    /** Whether the formula can jump where @p variable passes some value: a
     * condition, sign, rint, floor or ceil depends on it. */
    bool
    can_jump_with(const std::string &variable) const;

    const std::string &
    formula() const
    {
      return text;
    }

    /** Parameter with this formula, "[Section] Name", or empty. */
    const std::string &
    parameter() const
    {
      return name;
    }

    /** Splits "a; b; c" at separators outside brackets, and parses each
     * formula; an empty text gives no formulas. */
    static std::vector<Expression>
    parse_list(const std::string &formulas,
               const char         separator,
               const std::string &variables = Variables::space_and_time,
               const std::string &parameter = "");

  private:
    struct Parser; // keeps muParser.h out of every includer
    std::shared_ptr<Parser> parser;
    std::string             text;
    std::string             name; ///< name of the parameter
    std::set<std::string>   variables;
  };
} // namespace Crevasse

#endif
