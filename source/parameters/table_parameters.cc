// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/csv_file.h>
#include <crevasse/base/expression.h>
#include <crevasse/base/summary.h>
#include <crevasse/base/text.h>
#include <crevasse/parameters/checker.h>
#include <crevasse/parameters/table_parameters.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <regex>
#include <set>

namespace Crevasse
{
  namespace
  {
    /** Name of the column that marks ends of steps. */
    constexpr const char *step_column = "step";



    /** Whether a comment chooses a monotone cubic. @throw SceneError if it
     * begins with the word interpolation and chooses nothing that is known. */
    bool
    is_monotone_cubic(const CsvFile &file)
    {
      constexpr auto          any_case = std::regex::icase;
      static const std::regex word("interpolation\\b.*", any_case);
      // Spreadsheets write separators of empty cells.
      static const std::regex setting(
        "interpolation[ =:]*(linear|(monotone +cubic))[ ,;\t\"]*", any_case);
      bool result = false;
      for (const std::string &comment : file.comments)
        if (const std::string text = Text::shorten(comment);
            std::regex_match(text, word))
          {
            std::smatch parts;
            file.demand(std::regex_match(text, parts, setting),
                        "the comment \"# " + text +
                          "\" must be \"# interpolation = linear\" or \"# "
                          "interpolation = monotone cubic\"");
            result = parts[2].matched;
          }
      return result;
    }



    void
    check_names(const CsvFile &file)
    {
      const std::vector<std::string> &names = file.names;
      file.demand(
        !names.empty() &&
          std::regex_match(names[0], std::regex("t|theta|x|y|z")),
        "the first column is \"" +
          (names.empty() ? "" : Text::shorten(names[0])) +
          "\"; it must be t, theta, x, y or z, on which the other columns "
          "depend. Commas separate columns");
      for (auto name = names.begin() + 1; name != names.end(); ++name)
        {
          file.demand(
            std::regex_match(*name, std::regex("[A-Za-z_]\\w{0,60}")),
            "the name of the column \"" + Text::shorten(*name) +
              "\" must consist of letters, digits and _; a unit follows in "
              "brackets, as in force [N]");
          file.demand(!Expression::is_known_name(*name) &&
                        std::count(names.begin(), name, *name) == 0,
                      "formulas or another column have the name of the column "
                      "\"" +
                        *name + "\" already; rename it");
        }
    }



    void
    check_ascent(const CsvFile &file, const bool can_jump)
    {
      const std::string         &name = file.names[0];
      const std::vector<double> &x    = file.columns[0];
      for (std::size_t k = 1; k < x.size(); ++k)
        file.demand((x[k] > x[k - 1] || (can_jump && x[k] == x[k - 1])) &&
                      (k < 2 || x[k] > x[k - 2]),
                    name + " = " + Text::from_number(x[k]) + " after " +
                      Text::from_number(x[k - 1]) + "; rows must ascend" +
                      (can_jump ? ", or have the same value twice for a jump"
                                : ", and a monotone cubic has no jumps"),
                    k);
      file.demand(
        file.names.size() > 1 && x.size() >= (can_jump ? 2 : 4) &&
          x.front() < x.back(),
        "a table has at least two columns and two rows with different "
        "values of " +
          name + ", as a monotone cubic four");
    }



    /** Adds the columns of a file. */
    void
    add_table(const std::string   &name,
              TableFunctions      &functions,
              std::vector<double> &step_ends)
    {
      const CsvFile file(name);
      const bool    is_cubic = is_monotone_cubic(file);
      check_names(file);
      check_ascent(file, !is_cubic);
      const std::vector<double> &x = file.columns[0];
      std::vector<double>        marks(x.size());
      for (std::size_t i = 1; i < file.names.size(); ++i)
        if (file.names[i] == step_column)
          marks = file.columns[i];
        else if (const auto [function, is_new] =
                   functions.try_emplace(file.names[i],
                                         name,
                                         file.names[0],
                                         x,
                                         file.columns[i],
                                         is_cubic);
                 !is_new)
          file.demand(false,
                      std::filesystem::equivalent(name, function->second.file)
                        ? "the file is listed twice"
                        : "the column \"" + file.names[i] + "\" is in " +
                            function->second.file + " as well; rename one");
      for (std::size_t k = 0; k < x.size(); ++k)
        {
          file.demand(marks[k] == 0. || marks[k] == 1.,
                      "step = " + Text::from_number(marks[k]) +
                        " must be 1 where a time step has to end, otherwise 0",
                      k);
          if (file.names[0] == "t" &&
              (marks[k] == 1. || (k > 0 && x[k] == x[k - 1])))
            step_ends.push_back(x[k]);
        }
    }
  } // namespace



  void
  TableParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
      "Files",
      files,
      "CSV files of measured histories and material data, with a line of names "
      "and rows of numbers. Each column but the first is a function of the "
      "first, such as force(t) or E(theta), which all formulas may call. The "
      "first column is t (from 0 to Period), theta, x, y or z. The program "
      "looks for files next to the scene file, then in the working directory. "
      "Allowed: empty, or names separated by commas",
      dealii::Patterns::List(dealii::Patterns::Anything()));
  }



  void
  TableParameters::read(Problems &problems)
  {
    const Checker checker(section, problems);
    for (const std::string &file : files)
      if (checker.demand_file("Files", file))
        checker.demand_readable("Files", [&]() {
          add_table(file, *functions, step_ends);
        });
    // Formulas that call them would only confuse.
    if (problems.concern(section, "Files"))
      problems.throw_if_any();
  }



  void
  TableParameters::find_calls(const dealii::ParameterHandler &prm)
  {
    std::ostringstream text;
    prm.print_parameters(text, dealii::ParameterHandler::ShortJSON);
    const Summary scene = Summary::parse(text.str()).flatten();
    // Counts are limited: std::regex is recursive.
    static const std::regex call(
      "(\\w{1,60})\\s{0,20}\\(\\s{0,20}(t\\s{0,20}\\))?");
    for (const auto &[pointer, value] : scene.items())
      {
        const std::string formula = value.get<std::string>();
        for (std::sregex_iterator c(formula.begin(), formula.end(), call), end;
             c != end;
             ++c)
          if (const auto f = functions->find((*c)[1]); f != functions->end())
            {
              f->second.is_called = true;
              if (f->second.is_of_time() && !(*c)[2].matched)
                warnings.push_back(
                  "[Tables] Files = " + f->second.file + ": " + f->first +
                  " has rows of t, but another argument in " +
                  pointer.substr(1) + " = " + Text::shorten(formula) +
                  ". Steps do not end at its peaks there; name their instants "
                  "in [Time integration] Steps");
            }
      }
  }



  void
  TableParameters::check(const double period, Problems &problems) const
  {
    std::set<std::string> wrong_files;
    for (const auto &[name, f] : *functions)
      {
        constexpr double rounding = 1e-9;
        if (!f.is_of_time())
          continue;
        if ((std::abs(f.x.front()) > rounding * period ||
             std::abs(f.x.back() - period) > rounding * period) &&
            wrong_files.insert(f.file).second)
          problems.add(section,
                       "Files",
                       Text::Message()
                         << f.file << ": t goes from "
                         << Text::from_number(f.x.front()) << " to "
                         << Text::from_number(f.x.back())
                         << "; it must go from 0 to [Loads] Period = "
                         << period);
        if (std::abs(f.y.front() - f.y.back()) >
            rounding * (f.largest - f.least))
          problems.add(section,
                       "Files",
                       Text::Message()
                         << f.file << ": " << name << " begins with "
                         << f.y.front() << " and ends with " << f.y.back()
                         << ", but every period is the same; let the last row "
                            "have the first value, if need be after a jump");
      }
  }
} // namespace Crevasse
