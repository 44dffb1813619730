// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_expression_h
#define crevasse_base_expression_h

#include <crevasse/base/table_function.h>

#include <deal.II/base/point.h>

#include <set>

namespace Crevasse
{
  /** Point, time, temperature and material where a formula is evaluated. */
  template <int dim>
  struct Place
  {
    dealii::Point<dim> point;
    double             t           = 0.;
    double             temperature = 0.; ///< theta
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
      static constexpr const char *temperature    = "theta";
      static constexpr const char *space          = "x, y, z";
      static constexpr const char *space_and_time = "x, y, z, t";
      static constexpr const char *space_time_and_temperature =
        "x, y, z, t, theta";
      static constexpr const char *space_time_and_material =
        "x, y, z, t, theta, material";
    };

    /** @param parameter Parameter with this formula, "[Section] Name".
     * @param tables Further functions that the formula may call, or null.
     * @throw SceneError with the message of muParser if the formula does not
     * parse or uses an unknown name. */
    explicit Expression(const std::string &formula,
                        const std::string &allowed = Variables::space_and_time,
                        const std::string &parameter = "",
                        const Tables      &tables    = nullptr);

    /** Whether all formulas know a variable, constant or function. */
    static bool
    is_known_name(const std::string &name);

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
     * condition, sign, rint, floor, ceil or a table with a jump depends on it.
     */
    bool
    can_jump_with(const std::string &variable) const;

    /** Sorted rows of the tables over t in the formula: kinks. */
    std::set<double>
    kinks_in_time() const;

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
               const std::string &parameter = "",
               const Tables      &tables    = nullptr);

  private:
    /** Function of a table that the formula may call, or null. */
    const TableFunction *
    table(const std::string &function) const;

    struct Parser; // keeps muParser.h out of every includer
    std::shared_ptr<Parser> parser;
    std::string             text;
    std::string             name; ///< name of the parameter
    std::set<std::string>   variables;
  };
} // namespace Crevasse

#endif
