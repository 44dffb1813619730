// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/csv_file.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/base/text_file.h>

#include <deal.II/base/utilities.h>

#include <boost/tokenizer.hpp>
#include <sstream>

namespace Crevasse
{
  namespace
  {
    using Quoted = boost::escaped_list_separator<char>;

    std::vector<std::string>
    split_cells(const std::string &line, const char separator)
    {
      const boost::tokenizer<Quoted> all(
        line, Quoted("", std::string(1, separator), "\""));
      std::vector<std::string> cells;
      for (const std::string &cell : all)
        cells.push_back(dealii::Utilities::trim(cell));
      while (!cells.empty() && cells.back().empty())
        cells.pop_back();
      return cells;
    }
  } // namespace



  CsvFile::CsvFile(const std::string &file_name)
    : file_name(file_name)
  {
    std::istringstream text(read_text_file(file_name));
    char               separator = 0;
    std::size_t        number    = 0;
    for (std::string line; std::getline(text, line);)
      {
        ++number;
        line = dealii::Utilities::trim(line);
        if (line.empty())
          continue;
        if (names.empty() && line.rfind("sep=", 0) == 0)
          {
            separator = line.size() > 4 ? line[4] : '\t';
            continue;
          }
        // A spreadsheet may quote a comment.
        if (const std::size_t mark = line.find('#');
            line.find_first_not_of("\"# ") > mark)
          {
            comments.push_back(dealii::Utilities::trim(line.substr(mark + 1)));
            continue;
          }
        if (separator == 0)
          {
            // The first column has no separator in its name.
            const std::size_t first = line.find_first_of(";\t,");
            separator = first == std::string::npos ? ',' : line[first];
          }
        const std::vector<std::string> cells = split_cells(line, separator);
        if (names.empty())
          for (const std::string &cell : cells)
            names.push_back(dealii::Utilities::trim(
              cell.substr(0, cell.find_first_of("[("))));
        else if (!cells.empty())
          {
            lines.push_back(number);
            read_numbers(cells);
          }
        columns.resize(names.size());
      }
  }



  void
  CsvFile::read_numbers(const std::vector<std::string> &cells)
  {
    const std::size_t k = n_rows();
    demand(cells.size() == names.size(),
           "a row needs " + std::to_string(names.size()) + " numbers (" +
             Text::shorten(Text::join(names, ", ")) + "), this one has " +
             std::to_string(cells.size()) +
             "; numbers have a decimal point, not a comma",
           k);
    for (std::size_t i = 0; i < cells.size(); ++i)
      {
        const auto value = Text::to_number(cells[i]);
        demand(value.has_value(),
               names[i] + " = \"" + Text::shorten(cells[i]) +
                 "\" must be a number, with a decimal point",
               k);
        columns[i].push_back(*value);
      }
  }



  void
  CsvFile::demand(const bool         fulfilled,
                  const std::string &reason,
                  const std::size_t  k) const
  {
    if (!fulfilled)
      throw SceneError(
        file_name +
        (k < lines.size() ? ", row " + std::to_string(lines[k]) : "") + ": " +
        reason);
  }
} // namespace Crevasse
