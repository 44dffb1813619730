// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/expression.h>
#include <crevasse/base/text_file.h>
#include <crevasse/parameters/checker.h>
#include <crevasse/parameters/table_parameters.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <regex>

namespace Crevasse
{
  namespace
  {
    /** Name of the column that marks ends of steps. */
    constexpr const char *step_column = "step";



    /** Reads a table. Errors name the file and the row. */
    class TableFile
    {
    public:
      std::vector<std::string>         names;
      std::vector<std::vector<double>> columns;
      bool                             is_monotone_cubic = false;

      explicit TableFile(const std::string &file)
        : file(file)
      {
        std::istringstream text(read_text_file(file));
        for (std::string line; std::getline(text, line);)
          {
            ++row;
            line = dealii::Utilities::trim(line);
            if (line[0] == '#')
              read_comment(line);
            else if (!line.empty() && names.empty())
              read_names(line);
            else if (!line.empty())
              read_numbers(line);
          }
        demand(names.size() > 1 &&
                 columns[0].size() >= (is_monotone_cubic ? 4 : 2) &&
                 columns[0].front() < columns[0].back(),
               "a table has a line with the names of two columns or more, and "
               "at least two different rows, four for a monotone cubic");
      }

      void
      demand(const bool fulfilled, const std::string &reason) const
      {
        if (!fulfilled)
          throw SceneError(file + ", row " + std::to_string(row) + ": " +
                           reason);
      }

    private:
      const std::string file;
      std::size_t       row       = 0;
      char              separator = ',';

      void
      read_comment(const std::string &line)
      {
        // Spreadsheets write separators of empty cells.
        static const std::regex setting("# *interpolation *=(.*?)[ ,;\\t]*");
        std::smatch             parts;
        if (!std::regex_match(line, parts, setting))
          return;
        const std::string kind = Text::squeeze(parts[1]);
        is_monotone_cubic      = kind == "monotone cubic";
        demand(is_monotone_cubic || kind == "linear",
               "interpolation = " + kind + " must be linear or monotone cubic");
      }

      void
      read_names(const std::string &line)
      {
        const std::size_t first = line.find_first_of(";\t,");
        if (first != std::string::npos)
          separator = line[first];
        for (const std::string &cell : Text::split(line, separator))
          // Units follow in brackets.
          names.push_back(
            dealii::Utilities::trim(cell.substr(0, cell.find_first_of("[("))));
        columns.resize(names.size());
        demand(std::regex_match(names[0], std::regex("t|theta|x|y|z")),
               "the first column is \"" + Text::shorten(names[0]) +
                 "\"; it must be t, theta, x, y or z, on which the other "
                 "columns depend. Commas separate columns");
        for (auto name = names.begin() + 1; name != names.end(); ++name)
          {
            demand(std::regex_match(*name, std::regex("[A-Za-z_]\\w{0,60}")),
                   "the name of the column \"" + Text::shorten(*name) +
                     "\" must consist of letters, digits and _; a unit follows "
                     "in brackets, as in force [N]");
            demand(!Expression::is_known_name(*name) &&
                     std::count(names.begin(), name, *name) == 0,
                   "formulas or another column have the name of the column \"" +
                     *name + "\" already; rename it");
          }
      }

      void
      read_numbers(const std::string &line)
      {
        const std::vector<std::string> cells = Text::split(line, separator);
        demand(cells.size() == names.size(),
               "there are " + std::to_string(cells.size()) +
                 " numbers for the columns " + Text::join(names, ", ") +
                 "; each needs one, with a decimal point, not a comma");
        for (std::size_t i = 0; i < cells.size(); ++i)
          {
            const auto number = Text::to_number(cells[i]);
            demand(number.has_value(),
                   names[i] + " = \"" + Text::shorten(cells[i]) +
                     "\" must be a number, with a decimal point");
            columns[i].push_back(*number);
          }
        const auto x = columns[0].rbegin();
        const auto n = columns[0].size();
        demand((n < 2 || x[0] > x[1] || (x[0] == x[1] && !is_monotone_cubic)) &&
                 (n < 3 || x[0] > x[2]),
               names[0] + " = " + cells[0] + " after " +
                 Text::from_number(x[n < 2 ? 0 : 1]) +
                 "; rows must ascend, or have the same value twice for a jump, "
                 "which a monotone cubic does not have");
      }
    };



    /** Adds the columns of a file. */
    void
    add_table(const std::string   &file,
              TableFunctions      &functions,
              std::vector<double> &step_ends)
    {
      const TableFile            table(file);
      const std::vector<double> &x = table.columns[0];
      std::vector<double>        marks(x.size());
      for (std::size_t i = 1; i < table.names.size(); ++i)
        if (table.names[i] == step_column)
          marks = table.columns[i];
        else
          {
            const auto [function, is_new] = functions.try_emplace(
              table.names[i],
              TableFunction{file, table.names[0], x, table.columns[i], {}});
            table.demand(is_new,
                         "the column \"" + table.names[i] + "\" is in " +
                           function->second.file + " as well; rename one");
            if (table.is_monotone_cubic)
              function->second.make_monotone_cubic();
          }
      for (std::size_t i = 0; i < x.size() && table.names[0] == "t"; ++i)
        if (marks[i] != 0. || (i > 0 && x[i] == x[i - 1]))
          step_ends.push_back(x[i]);
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
  TableParameters::check(const double period, Problems &problems) const
  {
    constexpr double rounding = 1e-9;
    const auto       differ = [](const double a, const double b, double size) {
      return std::abs(a - b) > rounding * size;
    };
    for (const auto &[name, f] : *functions)
      if (const auto [least, largest] =
            std::minmax_element(f.y.begin(), f.y.end());
          f.is_of_time() &&
          (differ(f.x.front(), 0., period) ||
           differ(f.x.back(), period, period) ||
           differ(f.y.front(), f.y.back(), *largest - *least)))
        problems.add(
          section,
          "Files",
          Text::Message()
            << f.file << ", last row: t = " << f.x.back() << ", " << name
            << " = " << f.y.back() << " after t = " << f.x.front() << ", "
            << name << " = " << f.y.front()
            << " in the first row; t must go from 0 to [Loads] Period = "
            << period << ", and " << name
            << " return to its first value, if need be by a jump at the end");
  }
} // namespace Crevasse
