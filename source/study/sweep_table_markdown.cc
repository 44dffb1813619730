// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/study/sweep_table.h>

#include <cstdio>
#include <utility>

namespace Crevasse
{
  namespace
  {
    /** Costs by their names in sweep.csv, and what people call them. */
    constexpr std::pair<const char *, const char *> costs_for_people[] = {
      {"vi_solves", "VIs"},
      {"linear_solves", "linear solves"},
      {"factorisations", "factorisations"},
      {"rate_evaluations", "rate evaluations"},
      {"seconds", "seconds"},
      {"seconds_time_stepping", "stepping (s)"},
      {"processor_seconds", "CPU (s)"}};



    /** For people: two significant digits. */
    std::string
    short_number(const std::optional<double> &number, const char *format)
    {
      if (!number)
        return "";
      char text[40];
      std::snprintf(text, sizeof(text), format, *number);
      return text;
    }



    std::string
    markdown_row(const std::vector<std::string> &cells)
    {
      std::string row = "|";
      for (const std::string &cell : cells)
        {
          row += ' ';
          for (const char c : cell)
            row += c == '|'    ? std::string("\\|")
                   : c == '\n' ? std::string(" ")
                               : std::string(1, c);
          row += " |";
        }
      return row + '\n';
    }



    std::string
    in_one_line(std::string text)
    {
      for (char &c : text)
        if (c == '\n')
          c = ' ';
      return text;
    }



    /** A cost for people; nothing if it is not known. */
    std::string
    cost(const SweepResult &result, const std::string &name)
    {
      if (!result.costs.contains(name))
        return "";
      const Summary &value = result.costs.at(name);
      if (!value.is_number_float())
        return value.dump();
      const double seconds = value.get<double>();
      return short_number(seconds, seconds < 10. ? "%.2g" : "%.1f");
    }



    /** What a run has cost, in words. */
    std::string
    costs_in_words(const SweepResult &result)
    {
      const bool contact = cost(result, "vi_solves") != "0";
      return (contact ? cost(result, "vi_solves") + " VIs"
                      : cost(result, "linear_solves") + " linear solves") +
             ", " + cost(result, "seconds") + " s";
    }
  } // namespace



  std::string
  SweepTable::short_name(const std::size_t parameter) const
  {
    const auto without_section = [](const std::string &name) {
      return name.substr(name.rfind('/') + 1);
    };
    const std::string name = without_section(plan.parameters()[parameter]);
    for (std::size_t k = 0; k < plan.parameters().size(); ++k)
      if (k != parameter && without_section(plan.parameters()[k]) == name)
        return plan.parameters()[parameter];
    return name;
  }



  std::string
  SweepTable::markdown_header() const
  {
    std::vector<std::string> header;
    for (std::size_t k = 0; k < plan.parameters().size(); ++k)
      header.push_back(short_name(k));
    for (const Quantity &quantity : quantities)
      {
        header.push_back("error of " + quantity.name);
        if (!numbers.empty())
          header.push_back("order");
      }
    for (const auto &[name, title] : costs_for_people)
      header.push_back(title);
    std::vector<std::string> rule(header.size(), "---:");
    header.push_back("status");
    rule.push_back("---");
    return markdown_row(header) + markdown_row(rule);
  }



  std::string
  SweepTable::markdown() const
  {
    std::string text = "# " + title + "\n\n" + reference;
    if (reference_result)
      text += " (" + costs_in_words(*reference_result) + ")";
    text += ".\n\n" + markdown_header();
    for (std::size_t p = 0; p < results.size(); ++p)
      {
        std::vector<std::string> row = plan.points()[p].values;
        for (const Quantity &quantity : quantities)
          {
            row.push_back(short_number(error(p, quantity), "%.1e"));
            if (!numbers.empty())
              row.push_back(short_number(order(p, quantity), "%.2f"));
          }
        for (const auto &[name, title] : costs_for_people)
          row.push_back(cost(results[p], name));
        row.push_back(results[p].status);
        text += markdown_row(row);
      }
    return text + markdown_notes();
  }



  std::string
  SweepTable::markdown_notes() const
  {
    std::string notes;
    for (std::size_t p = 0; p < results.size(); ++p)
      {
        const std::string begin = "- " + values(p) + ": ";
        if (!results[p].message.empty())
          notes += begin + results[p].status + ". " +
                   in_one_line(results[p].message) + '\n';
        for (const Quantity &quantity : quantities)
          {
            const auto found = results[p].errors.find(quantity.name);
            if (found != results[p].errors.end() &&
                !found->second.reason.empty())
              notes += begin + "no error of " + quantity.name + ", because " +
                       found->second.reason + ".\n";
          }
      }
    return notes.empty() ? "" : "\nRemarks:\n\n" + notes;
  }



  std::string
  SweepTable::values(const std::size_t point) const
  {
    std::vector<std::string> parts;
    for (std::size_t k = 0; k < plan.parameters().size(); ++k)
      parts.push_back(short_name(k) + " = " + plan.points()[point].values[k]);
    return Text::join(parts, ", ");
  }



  std::string
  SweepTable::line(const std::size_t point) const
  {
    const SweepResult &result = results[point];
    std::string        text   = values(point) + ": ";
    if (!result.has_results())
      return text + result.status;

    constexpr std::size_t    most = 3;
    std::vector<std::string> parts;
    for (const Quantity &quantity : quantities)
      if (const auto value = error(point, quantity);
          value && parts.size() < most)
        parts.push_back(quantity.name + ' ' + short_number(value, "%.1e"));
    text += parts.empty() ? "no error" : "error of " + Text::join(parts, ", ");
    text += "; " + costs_in_words(result);
    return result.status == "done" ? text : text + "; " + result.status;
  }
} // namespace Crevasse
