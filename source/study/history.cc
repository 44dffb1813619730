// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/study/history.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace Crevasse
{
  namespace
  {
    std::vector<std::string>
    cells_of(const std::string &line)
    {
      std::vector<std::string> cells(1);
      for (const char c : line)
        if (c == ',')
          cells.emplace_back();
        else
          cells.back() += c;
      return cells;
    }



    bool
    contains(const std::string &folder, const Quantity &quantity)
    {
      return std::filesystem::exists(folder + '/' + quantity.table() + ".csv");
    }



    History
    table_of(const std::string &folder, const Quantity &quantity)
    {
      return History(folder + '/' + quantity.table() + ".csv");
    }



    MeasuredError
    compare_with_formula(const Quantity &quantity, const History &history)
    {
      const std::vector<double> *column = history.find(quantity.column());
      if (column == nullptr)
        return MeasuredError::none("the run has no such column");
      const std::vector<double> &t = history.instants();
      Extremes                   extremes;
      try
        {
          for (std::size_t i = 0; i < t.size(); ++i)
            extremes.add((*column)[i],
                         quantity.exact->value(dealii::Point<2>(), t[i]));
        }
      catch (const SceneError &error)
        {
          return MeasuredError::none(error.what());
        }
      if (t.empty() || t.back() == 0.)
        return MeasuredError::none("the run has no instant but t = 0");
      return MeasuredError::relative(extremes, t.size());
    }



    MeasuredError
    compare_with_run(const Quantity &quantity,
                     const History  &history,
                     const History  &reference,
                     const double    period)
    {
      const CommonInstants common(history.instants(),
                                  reference.instants(),
                                  period);
      Extremes             extremes;
      bool                 found = false;
      for (const std::string &name : reference.columns())
        if (quantity.selects(name) && history.find(name) != nullptr)
          {
            found               = true;
            const auto &values  = *history.find(name);
            const auto &correct = *reference.find(name);
            for (const double value : correct)
              extremes.add(value, value);
            for (const auto &[i, j] : common.pairs)
              extremes.add(values[i], correct[j]);
          }
      if (!found)
        return MeasuredError::none("the runs have no such column");
      if (!common.objection.empty())
        return MeasuredError::none(common.objection, common.pairs.size());
      return MeasuredError::relative(extremes, common.pairs.size());
    }
  } // namespace



  History::History(const std::string &file_name)
    : file_name(file_name)
  {
    std::ifstream file(file_name);
    std::string   line;
    if (!std::getline(file, line))
      throw FileError("Cannot read " + file_name + ".");
    names = cells_of(line);
    values.resize(names.size());
    while (std::getline(file, line))
      {
        // The last line of a whole table ends too.
        if (file.eof())
          throw FileError(file_name + ": the last line is not complete.");
        read_row(line);
      }
    if (find("t") == nullptr && find("t_end") == nullptr)
      throw FileError(file_name + ": there is no column t.");
  }



  void
  History::read_row(const std::string &line)
  {
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() != names.size())
      throw FileError(file_name + ": a row has " +
                      std::to_string(cells.size()) + " entries instead of " +
                      std::to_string(names.size()) + ".");
    for (std::size_t c = 0; c < cells.size(); ++c)
      {
        const char *begin = cells[c].data();
        const char *end   = begin + cells[c].size();
        double      value = 0.;
        const auto  read  = std::from_chars(begin, end, value);
        if (read.ec != std::errc() || read.ptr != end)
          throw FileError(file_name + ": \"" + cells[c] + "\" is no number.");
        values[c].push_back(value);
      }
  }



  const std::vector<std::string> &
  History::columns() const
  {
    return names;
  }



  const std::vector<double> *
  History::find(const std::string &column) const
  {
    const auto place = std::find(names.begin(), names.end(), column);
    return place == names.end() ? nullptr : &values[place - names.begin()];
  }



  const std::vector<double> &
  History::instants() const
  {
    const std::vector<double> *t = find("t");
    return t != nullptr ? *t : *find("t_end");
  }



  void
  History::keep_last_period(const double period)
  {
    if (find("t") == nullptr || instants().empty())
      return;
    const double begin = instants().back() - period, rounding = 1e-9 * period;
    const std::size_t first =
      std::lower_bound(instants().begin(), instants().end(), begin - rounding) -
      instants().begin();
    for (std::vector<double> &column : values)
      column.erase(column.begin(), column.begin() + first);
  }



  void
  History::begin_at_zero()
  {
    for (std::size_t c = 0; c < names.size(); ++c)
      if (names[c] == "t" && !values[c].empty())
        {
          const double begin = values[c].front();
          for (double &t : values[c])
            t -= begin;
        }
  }



  MeasuredError
  history_error(const Quantity    &quantity,
                const std::string &folder,
                const std::string &reference,
                const double       period,
                const Compared     compared)
  {
    if (!contains(folder, quantity))
      return MeasuredError::none("the run has no table " + quantity.table());
    History history = table_of(folder, quantity);
    if (compared != Compared::whole_run)
      history.keep_last_period(period);
    if (quantity.exact != nullptr)
      return compare_with_formula(quantity, history);
    if (!contains(reference, quantity))
      return MeasuredError::none("the reference has no table " +
                                 quantity.table());
    History correct = table_of(reference, quantity);
    if (compared != Compared::whole_run)
      {
        correct.keep_last_period(period);
        history.begin_at_zero();
        correct.begin_at_zero();
      }
    return compare_with_run(quantity, history, correct, period);
  }
} // namespace Crevasse
