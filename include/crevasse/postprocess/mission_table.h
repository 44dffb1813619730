// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_mission_table_h
#define crevasse_postprocess_mission_table_h

#include <crevasse/base/csv_table.h>
#include <crevasse/time/observer.h>

#include <functional>
#include <utility>

namespace Crevasse
{
  /** Number of a period by name, which can be asked for at its end. */
  using PeriodNumber = std::pair<std::string, std::function<double()>>;

  /** missions.csv: numbers of each mission, with the periods that were computed
   * until it. */
  class MissionTable : public Observer
  {
  public:
    MissionTable(CsvTable &&table, const std::vector<PeriodNumber> &numbers)
      : table(std::move(table))
      , numbers(numbers)
    {
    }

    static std::vector<std::string>
    columns(const std::vector<PeriodNumber> &numbers)
    {
      std::vector<std::string> names = {"mission",
                                        "evaluations",
                                        "stress_largest"};
      for (const PeriodNumber &number : numbers)
        names.push_back(number.first);
      return names;
    }

    void
    observe(const Sample &) override
    {
    }

    void
    end_of_period(const PeriodReport &report) override
    {
      if (report.mission == 0)
        return;
      std::vector<double> row = {double(report.mission),
                                 double(report.period),
                                 report.largest_stress};
      for (const PeriodNumber &number : numbers)
        row.push_back(number.second());
      table.add_row(row);
    }

  private:
    CsvTable                        table;
    const std::vector<PeriodNumber> numbers;
  };
} // namespace Crevasse

#endif
