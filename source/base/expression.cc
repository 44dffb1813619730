// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/expression.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <muParser.h>
#include <regex>

namespace Crevasse
{
  struct Expression::Parser
  {
    mu::Parser parser;
    // Not numbers: parsing must not count as a value that tables see.
    static constexpr double none = std::numeric_limits<double>::quiet_NaN();
    double x = none, y = none, z = none, t = none, theta = none,
           material = none;
    Tables tables; ///< or null
  };



  namespace
  {
    /** Defines functions of deal.II's formulas that muParser lacks. */
    void
    define_functions_and_constants(mu::Parser &parser)
    {
      using Function = double (*)(double);
      parser.DefineFun<Function>("floor", std::floor);
      parser.DefineFun<Function>("ceil", std::ceil);
      parser.DefineFun<double (*)(double, double)>("pow", std::pow);
      parser.DefineFun<double (*)(double, double, double)>(
        "if", [](const double condition, const double yes, const double no) {
          return condition != 0. ? yes : no;
        });
      parser.DefineConst("pi", dealii::numbers::PI);
      parser.DefineConst("Pi", dealii::numbers::PI);
    }



    /** Whether a formula has a single "=": muParser would assign to x or t
     * instead of comparing them. */
    bool
    has_assignment(const std::string &formula)
    {
      return std::regex_search(formula, std::regex("(^|[^<>!=])=($|[^=])"));
    }



    /** Moves blanks between the name of a function and its bracket, which
     * muParser rejects, before the name: positions in messages stay. */
    std::string
    join_functions(const std::string &formula)
    {
      // Names are short; std::regex is recursive.
      static const std::regex call("\\b(\\w{1,20})(\\s{1,20})\\(");
      return std::regex_replace(formula, call, "$2$1(");
    }



    [[noreturn]] void
    refuse_formula(const std::string &formula, const std::string &reason)
    {
      throw SceneError("the formula \"" + Text::shorten(formula) +
                       "\" cannot be used: " + reason);
    }



    std::string
    describe(const mu::Parser::exception_type &error,
             const std::string                &variables)
    {
      std::string message = error.GetMsg();
      if (message.find("position") == std::string::npos && error.GetPos() > 0)
        message += " (position " + std::to_string(error.GetPos()) + ")";
      if (error.GetCode() == mu::ecUNASSIGNABLE_TOKEN)
        message += " Known names: " + variables +
                   ", pi and the functions of muParser, if, pow, floor, "
                   "ceil, and the columns of [Tables].";
      return message;
    }
  } // namespace



  Expression::Expression(const std::string &formula,
                         const std::string &allowed,
                         const std::string &parameter,
                         const Tables      &tables)
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
        parser->tables = tables;
        if (tables != nullptr)
          for (const auto &[function, rows] : *tables)
            mu.DefineFunUserData<double (*)(void *, double)>(
              function,
              [](void *f, const double at) {
                return (*static_cast<const TableFunction *>(f))(at);
              },
              const_cast<TableFunction *>(&rows));
        const std::map<std::string, double *> values = {
          {"x", &parser->x},
          {"y", &parser->y},
          {"z", &parser->z},
          {"t", &parser->t},
          {"theta", &parser->theta},
          {"material", &parser->material}};
        for (const std::string &variable : Text::split(allowed, ','))
          mu.DefineVar(variable, values.at(variable));
        mu.SetExpr(join_functions(text));
        // muParser parses only when it evaluates.
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



  bool
  Expression::is_known_name(const std::string &name)
  {
    mu::Parser known;
    define_functions_and_constants(known);
    const auto variables = Text::split(Variables::space_time_and_material, ',');
    return std::count(variables.begin(), variables.end(), name) > 0 ||
           known.GetFunDef().count(name) > 0 ||
           known.GetConst().count(name) > 0;
  }



  const TableFunction *
  Expression::table(const std::string &function) const
  {
    return parser->tables != nullptr && parser->tables->count(function) > 0
             ? &parser->tables->at(function)
             : nullptr;
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
      ": keep divisors away from 0, and the arguments of sqrt and log "
      "positive, for example with max(x, 1e-12).");
  }



  bool
  Expression::is_zero() const
  {
    return is_constant() && parser->parser.Eval() == 0.;
  }



  std::vector<Expression>
  Expression::parse_list(const std::string &formulas,
                         const char         separator,
                         const std::string &variables,
                         const std::string &parameter,
                         const Tables      &tables)
  {
    std::vector<Expression> expressions;
    std::string             part;
    const auto              close_part = [&]() {
      const std::string formula = std::exchange(part, "");
      expressions.emplace_back(formula, variables, parameter, tables);
    };
    int depth = 0;
    for (const char c : formulas)
      {
        depth += c == '(' ? 1 : (c == ')' ? -1 : 0);
        if (c == separator && depth == 0)
          close_part();
        else
          part += c;
      }
    if (!dealii::Utilities::trim(part).empty())
      close_part();
    return expressions;
  }



  bool
  Expression::can_jump_with(const std::string &variable) const
  {
    /** A level of nested brackets, divided into parts by commas, "?" and ":"; a
     * part includes deeper levels. */
    struct Level
    {
      std::string function; ///< name before the bracket
      bool        is_first_argument = true;
      std::size_t begin             = 0; ///< first character of the part
      bool        compares = false;      ///< whether it compares at this level
    };
    static const std::regex last_word("(\\w*) *$"),
      jumping("sign|rint|floor|ceil");
    const std::regex   as_word("\\b" + variable + "\\b");
    std::vector<Level> levels(1);
    const std::string  all = text + ',';
    for (std::size_t i = 0; i < all.size(); ++i)
      {
        Level            &level = levels.back();
        const std::string part  = all.substr(level.begin, i - level.begin);
        std::smatch       word;
        if (all[i] == '(')
          {
            std::regex_search(part, word, last_word);
            levels.push_back({word[1], true, i + 1, false});
          }
        else if (std::strchr("<>=!&|", all[i]) != nullptr)
          level.compares = true;
        else if (std::strchr(",?:)", all[i]) != nullptr)
          {
            const TableFunction *rows = table(level.function);
            const bool           is_condition =
              (rows != nullptr && rows->can_jump()) || level.compares ||
              all[i] == '?' ||
              (level.function == "if" && level.is_first_argument) ||
              std::regex_match(level.function, jumping);
            if (is_condition && std::regex_search(part, as_word))
              return true;
            level.begin    = i + 1;
            level.compares = false;
            level.is_first_argument &= all[i] != ',';
            if (all[i] == ')')
              levels.pop_back();
          }
      }
    return false;
  }



  std::set<double>
  Expression::kinks_in_time() const
  {
    static const std::regex word("\\w+");
    std::set<double>        kinks;
    for (std::sregex_iterator w(text.begin(), text.end(), word), end; w != end;
         ++w)
      if (const TableFunction *rows = table(w->str());
          rows != nullptr && rows->is_of_time())
        kinks.insert(rows->x.begin(), rows->x.end());
    return kinks;
  }



  template double
  Expression::value<2>(const Place<2> &) const;
  template double
  Expression::value<3>(const Place<3> &) const;
} // namespace Crevasse
