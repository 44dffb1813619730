// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/parameters/formulas.h>
#include <crevasse/temperature/temperature.h>

#include <algorithm>

namespace Crevasse
{
  namespace
  {
    using Variables = Expression::Variables;



    void
    require_in_range(const Expression  &formula,
                     const Range       &range,
                     const std::string &what = "")
    {
      if (formula.is_constant() &&
          !range.contains(formula.value(dealii::Point<2>())))
        throw SceneError(what + range.text());
    }



    Formula::Parser
    formula_parser(const std::string &parameter,
                   const std::string &variables,
                   const Range       &range,
                   const Tables      &tables)
    {
      return [=](const std::string &text) {
        const Expression formula(text, variables, parameter, tables);
        require_in_range(formula, range);
        return formula;
      };
    }



    Formulas::Parser
    formulas_parser(const std::string &parameter,
                    const std::string &variables,
                    const char         separator,
                    const Tables      &tables)
    {
      return [=](const std::string &text) {
        const auto formulas =
          Expression::parse_list(text, separator, variables, parameter, tables);
        for (const Expression &formula : formulas)
          require_in_range(formula, Ranges::any_number, "every entry ");
        return formulas;
      };
    }
  } // namespace



  Formula::Parser
  FormulaParsers::material_formula(const std::string &name,
                                   const Range       &range) const
  {
    return formula_parser("[Material] " + name,
                          Variables::space_time_and_material,
                          range,
                          tables);
  }



  Formula::Parser
  FormulaParsers::time_factor(const std::string &name) const
  {
    return formula_parser("[Material] " + name,
                          Variables::time,
                          Ranges::positive,
                          tables);
  }



  Formulas::Parser
  FormulaParsers::material_components(const std::string &name) const
  {
    return formulas_parser("[Material] " + name,
                           Variables::space_time_and_material,
                           ',',
                           tables);
  }



  Formulas::Parser
  FormulaParsers::load_components(const std::string &name) const
  {
    return formulas_parser("[Loads] " + name,
                           Variables::space_and_time,
                           ';',
                           tables);
  }



  Formula::Parser
  FormulaParsers::growth_constant(const std::string &name,
                                  const Range       &range) const
  {
    return formula_parser("[Crack tip] " + name,
                          Variables::temperature,
                          range,
                          tables);
  }



  Formula::Parser
  FormulaParsers::gap_formula() const
  {
    return formula_parser("[Boundary] Gap",
                          Variables::space,
                          {-Ranges::largest,
                           0.,
                           "at most 0; negative values open the unloaded "
                           "crack"},
                          tables);
  }



  Formulas::Parser
  FormulaParsers::friction_coefficient() const
  {
    return [parse = formula_parser("[Boundary] Friction coefficient",
                                   Variables::space_time_and_temperature,
                                   {0., Ranges::largest, "at least 0"},
                                   tables)](const std::string &text) {
      return std::vector<Expression>{parse(text)};
    };
  }



  FormulaMatrix::Parser
  FormulaParsers::material_matrix(const std::string &name) const
  {
    return [parse_row = material_components(name)](const std::string &text) {
      std::vector<std::vector<Expression>> rows;
      for (const std::string &row : Text::split(text, ';'))
        rows.push_back(parse_row(row));
      return rows;
    };
  }



  std::function<std::vector<ChainBranch>(const std::string &)>
  FormulaParsers::chain_parser() const
  {
    return [parse = material_formula("Chain")](const std::string &text) {
      std::vector<ChainBranch> branches;
      double                   sum = 0.;
      for (const std::string &entry : Text::split(text, ';'))
        {
          const std::size_t colon = entry.find(':');
          const auto        fraction =
            Text::to_number(Text::squeeze(entry.substr(0, colon)));
          if (colon == std::string::npos || !fraction || !(*fraction > 0.))
            throw SceneError("\"" + Text::shorten(entry) +
                             "\" must be \"fraction: relaxation time\" with a "
                             "number greater than 0 before the colon; entries "
                             "are separated by semicolons");
          branches.push_back({*fraction, parse(entry.substr(colon + 1))});
          sum += *fraction;
        }
      constexpr double rounding = 1e-12;
      if (sum > 1. + rounding)
        throw SceneError("the sum of the fractions is " +
                         Text::from_number(sum) +
                         "; it must not exceed 1, the whole stiffness");
      return branches;
    };
  }



  Parsed<std::optional<Expression>>::Parser
  FormulaParsers::temperature_formula() const
  {
    return
      [tables = tables](const std::string &text) -> std::optional<Expression> {
        const std::string suffix = Text::suffix(text);
        if (suffix == ".csv" || suffix == ".pvd" || suffix == ".vtu" ||
            suffix == ".pvtu")
          throw SceneError(
            "tables and fields of other programs must be converted first: "
            "\"crevasse temperature " +
            text +
            " --output temperature.h5\"; a history of one temperature "
            "is a function of [Tables]");
        if (Temperature<2>::is_file(text))
          return {};
        try
          {
            return Expression(text,
                              Variables::space_and_time,
                              "[Loads] Temperature",
                              tables);
          }
        catch (const SceneError &error)
          {
            throw SceneError(std::string(error.what()) +
                             " (names of files end in .h5)");
          }
      };
  }



  std::optional<double>
  parse_optional_number(const std::string &text)
  {
    const auto number = Text::to_number(text);
    if (!number && !text.empty())
      throw SceneError("must be a number, or empty");
    return number;
  }



  void
  require_size(const FormulaMatrix &matrix,
               const unsigned int   dimension,
               const bool           plane_stress)
  {
    const std::size_t n = matrix->size();
    const std::string allowed =
      dimension == 3 ? "6 (11, 22, 33, 12, 13, 23) rows"
      : plane_stress ? "3 (11, 22, 12) or 4 (11, 22, 33, 12) rows"
                     : "4 (11, 22, 33, 12) rows";
    if (n != (dimension == 3 ? 6 : 4) &&
        !(dimension == 2 && plane_stress && n == 3))
      throw SceneError("must have " + allowed +
                       ", separated by semicolons; it has " +
                       std::to_string(n));
    for (std::size_t i = 0; i < n; ++i)
      if ((*matrix)[i].size() != n)
        throw SceneError("the row \"" +
                         Text::shorten(Text::split(matrix.text(), ';')[i]) +
                         "\" must have " + std::to_string(n) +
                         " entries, separated by commas; it has " +
                         std::to_string((*matrix)[i].size()));
  }



  void
  require_size(const Formulas &components, const unsigned int dimension)
  {
    const std::size_t n       = components->size();
    const bool        is_full = n == (dimension == 2 ? 4 : 6);
    if (n != 1 && !is_full && !(dimension == 2 && n == 3))
      throw SceneError(
        std::string("must have ") + (dimension == 2 ? "1, 3 or 4" : "1 or 6") +
        " components, separated by commas; it has " + std::to_string(n));
  }



  std::vector<Expression>
  entries(const FormulaMatrix &matrix)
  {
    std::vector<Expression> all;
    for (const auto &row : *matrix)
      all.insert(all.end(), row.begin(), row.end());
    return all;
  }



  bool
  are_zero(const std::vector<Expression> &formulas)
  {
    return std::all_of(formulas.begin(),
                       formulas.end(),
                       [](const Expression &formula) {
                         return formula.is_zero();
                       });
  }



  bool
  depend_on(const std::string             &variable,
            const std::vector<Expression> &formulas)
  {
    return std::any_of(formulas.begin(),
                       formulas.end(),
                       [&variable](const Expression &formula) {
                         return formula.depends_on(variable);
                       });
  }
} // namespace Crevasse
