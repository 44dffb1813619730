// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/expression.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <cmath>
#include <muParser.h>

namespace Crevasse
{
  struct Expression::Parser
  {
    mu::Parser parser;
    double     x = 0., y = 0., z = 0., t = 0., theta = 0., material = 0.;
  };



  namespace
  {
    double
    choose(const double condition, const double yes, const double no)
    {
      return condition != 0. ? yes : no;
    }



    double
    raise(const double base, const double exponent)
    {
      return std::pow(base, exponent);
    }



    double
    round_down(const double value)
    {
      return std::floor(value);
    }



    double
    round_up(const double value)
    {
      return std::ceil(value);
    }



    /** muParser lacks these, though deal.II's own formulas have them. */
    void
    define_functions_and_constants(mu::Parser &parser)
    {
      parser.DefineFun("if", choose);
      parser.DefineFun("pow", raise);
      parser.DefineFun("floor", round_down);
      parser.DefineFun("ceil", round_up);
      parser.DefineConst("pi", dealii::numbers::PI);
      parser.DefineConst("Pi", dealii::numbers::PI);
    }



    /** "=" alone is an assignment to muParser: it would change x or t instead
     * of comparing them. */
    bool
    has_assignment(const std::string &formula)
    {
      for (std::size_t i = 0; i < formula.size(); ++i)
        if (formula[i] == '=')
          {
            const bool doubled =
              i + 1 < formula.size() && formula[i + 1] == '=';
            const bool compares =
              i > 0 &&
              std::string("<>!").find(formula[i - 1]) != std::string::npos;
            if (!doubled && !compares)
              return true;
            i += doubled ? 1 : 0;
          }
      return false;
    }



    [[noreturn]] void
    refuse_formula(const std::string &formula, const std::string &reason)
    {
      throw SceneError("the formula \"" + Text::shorten(formula) +
                       "\" cannot be used: " + reason);
    }



    std::string
    describe(const mu::Parser::exception_type &error,
             const Expression::Variables       allowed)
    {
      std::string message = error.GetMsg();
      if (message.find("position") == std::string::npos && error.GetPos() > 0)
        message += " (position " + std::to_string(error.GetPos()) + ")";
      if (error.GetCode() == mu::ecUNASSIGNABLE_TOKEN)
        message += std::string(" Known are x, y, z, t, ") +
                   (allowed == Expression::Variables::space_time_and_material
                      ? "theta, material, "
                      : "") +
                   "pi and the functions of muParser, if, pow, floor, ceil.";
      return message;
    }
  } // namespace



  Expression::Expression(const std::string &formula,
                         const Variables    allowed,
                         const std::string &parameter)
    : parser(std::make_shared<Parser>())
    , text(dealii::Utilities::trim(formula))
    , name(parameter)
  {
    if (text.empty())
      refuse_formula(text, "it is empty.");
    if (has_assignment(text))
      refuse_formula(text, "\"=\" assigns; use \"==\" to compare.");

    mu::Parser &mu = parser->parser;
    try
      {
        define_functions_and_constants(mu);
        mu.DefineVar("x", &parser->x);
        mu.DefineVar("y", &parser->y);
        mu.DefineVar("z", &parser->z);
        mu.DefineVar("t", &parser->t);
        if (allowed == Variables::space_time_and_material)
          {
            mu.DefineVar("theta", &parser->theta);
            mu.DefineVar("material", &parser->material);
          }
        mu.SetExpr(text);
        // Only an evaluation makes muParser parse; the value at the origin may
        // well be infinite.
        mu.Eval();
        for (const auto &variable : mu.GetUsedVar())
          variables.insert(variable.first);
      }
    catch (const mu::Parser::exception_type &error)
      {
        refuse_formula(text, describe(error, allowed));
      }

    if (mu.GetNumResults() > 1)
      refuse_formula(
        text,
        "the comma makes it " + std::to_string(mu.GetNumResults()) +
          " formulas; numbers have a decimal point, and components are "
          "separated by semicolons.");
    if (variables.empty() && !std::isfinite(mu.Eval()))
      refuse_formula(text, "its value is not finite.");
  }



  template <int dim>
  double
  Expression::value(const Place<dim> &place) const
  {
    parser->x        = place.point[0];
    parser->y        = dim > 1 ? place.point[dim > 1 ? 1 : 0] : 0.;
    parser->z        = dim > 2 ? place.point[dim > 2 ? 2 : 0] : 0.;
    parser->t        = place.t;
    parser->theta    = place.temperature;
    parser->material = place.material;

    const double value = parser->parser.Eval();
    if (std::isfinite(value))
      return value;

    throw SceneError(
      (name.empty() ? "The" : name + ": the") + " formula \"" +
      Text::shorten(text) + "\" has no finite value at " +
      (depends_on_space() ? Text::from_point(place.point) + ", " : "") +
      "t = " + Text::from_number(place.t) +
      (depends_on("theta") ? ", theta = " + Text::from_number(place.temperature)
                           : "") +
      (depends_on("material") ? ", material = " + std::to_string(place.material)
                              : "") +
      ": try to keep divisors away from 0 and the arguments of sqrt and log "
      "positive, for example with max(x, 1e-12).");
  }



  template <int dim>
  double
  Expression::value(const dealii::Point<dim> &point, const double t) const
  {
    Place<dim> place;
    place.point = point;
    place.t     = t;
    return value(place);
  }



  bool
  Expression::depends_on(const std::string &variable) const
  {
    return variables.count(variable) > 0;
  }



  bool
  Expression::depends_on_time() const
  {
    return depends_on("t");
  }



  bool
  Expression::depends_on_space() const
  {
    return depends_on("x") || depends_on("y") || depends_on("z");
  }



  bool
  Expression::is_constant() const
  {
    return variables.empty();
  }



  bool
  Expression::is_zero() const
  {
    return is_constant() && parser->parser.Eval() == 0.;
  }



  const std::string &
  Expression::formula() const
  {
    return text;
  }



  const std::string &
  Expression::parameter() const
  {
    return name;
  }



  std::vector<Expression>
  Expression::parse_list(const std::string &formulas,
                         const std::string &parameter)
  {
    std::vector<Expression> expressions;
    for (const std::string &formula : Text::split(formulas, ';'))
      expressions.emplace_back(formula, Variables::space_and_time, parameter);
    return expressions;
  }



  std::vector<Expression>
  Expression::parse_row(const std::string &formulas,
                        const Variables    variables,
                        const std::string &parameter)
  {
    std::vector<Expression> expressions;
    std::size_t             begin = 0;
    int                     depth = 0;
    for (std::size_t i = 0; i <= formulas.size(); ++i)
      {
        const char c = i < formulas.size() ? formulas[i] : ',';
        depth += c == '(' ? 1 : (c == ')' ? -1 : 0);
        if (i == formulas.size() || (c == ',' && depth == 0))
          {
            expressions.emplace_back(formulas.substr(begin, i - begin),
                                     variables,
                                     parameter);
            begin = i + 1;
          }
      }
    return expressions;
  }



  template double
  Expression::value<2>(const Place<2> &) const;
  template double
  Expression::value<3>(const Place<3> &) const;
  template double
  Expression::value<2>(const dealii::Point<2> &, const double) const;
  template double
  Expression::value<3>(const dealii::Point<3> &, const double) const;
} // namespace Crevasse
