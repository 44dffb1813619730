// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/base/text_file.h>
#include <crevasse/study/sweep_table.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace Crevasse
{
  namespace
  {
    /** A cell of a table with commas, as RFC 4180 has it. */
    std::string
    csv_cell(const std::string &text)
    {
      if (text.find_first_of(",\"\n") == std::string::npos)
        return text;
      std::string quoted = "\"";
      for (const char c : text)
        quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
      std::replace(quoted.begin(), quoted.end(), '\n', ' ');
      return quoted + '"';
    }



    std::string
    three_decimals(const std::optional<double> &number)
    {
      char text[40] = "";
      if (number)
        std::snprintf(text, sizeof(text), "%.3f", *number);
      return text;
    }



    std::string
    csv_row(const std::vector<std::string> &cells)
    {
      std::vector<std::string> quoted;
      for (const std::string &cell : cells)
        quoted.push_back(csv_cell(cell));
      return Text::join(quoted, ",") + '\n';
    }
  } // namespace



  SweepTable::SweepTable(const SweepPlan             &plan,
                         const std::vector<Quantity> &quantities,
                         const std::string           &title,
                         const std::string           &reference)
    : plan(plan)
    , quantities(quantities)
    , title(title)
    , reference(reference)
    , numbers(plan.main_numbers())
  {
  }



  void
  SweepTable::set_reference(const SweepResult &result)
  {
    reference_result = result;
  }



  void
  SweepTable::add(const SweepResult &result)
  {
    results.push_back(result);
  }



  std::size_t
  SweepTable::n_with_results() const
  {
    std::size_t n = 0;
    for (const SweepResult &result : results)
      n += result.has_results() ? 1 : 0;
    return n;
  }



  void
  SweepTable::write(const std::string &directory) const
  {
    write_atomically(csv(), directory + "/sweep.csv");
    write_atomically(markdown(), directory + "/sweep.md");
    write_atomically(json().dump(2) + '\n', directory + "/sweep.json");
  }



  std::optional<double>
  SweepTable::error(const std::size_t point, const Quantity &quantity) const
  {
    const auto &errors = results[point].errors;
    const auto  found  = errors.find(quantity.name);
    return found == errors.end() ? std::nullopt : found->second.value;
  }



  std::optional<std::size_t>
  SweepTable::predecessor(const std::size_t point) const
  {
    const std::size_t axis = plan.main_axis();
    if (axis == plan.axes().size())
      return std::nullopt;
    // The next to it on the axis that has results, the other axes alike.
    for (std::size_t p = point; p-- > 0;)
      {
        auto indices  = plan.points()[p].indices;
        indices[axis] = plan.points()[point].indices[axis];
        if (indices == plan.points()[point].indices && results[p].has_results())
          return p;
      }
    return std::nullopt;
  }



  std::optional<double>
  SweepTable::order(const std::size_t point, const Quantity &quantity) const
  {
    const auto before = predecessor(point);
    if (!before)
      return std::nullopt;
    const auto e = error(*before, quantity), f = error(point, quantity);
    if (!e || !f || !(*e > 0.) || !(*f > 0.))
      return std::nullopt;
    const std::size_t axis   = plan.main_axis();
    const auto        number = [&](const std::size_t p) {
      return numbers[plan.points()[p].indices[axis]];
    };
    return -std::log(*f / *e) / std::log(number(point) / number(*before));
  }



  std::string
  SweepTable::csv() const
  {
    std::vector<std::string> header = {"point"};
    for (const std::string &name : plan.parameters())
      header.push_back(name);
    header.push_back("status");
    for (const Quantity &quantity : quantities)
      for (const char *what : {"error:", "order:", "instants:"})
        header.push_back(what + quantity.name);
    for (const std::string &name : cost_names())
      header.push_back(name);
    header.push_back("message");

    std::string text = csv_row(header);
    for (std::size_t p = 0; p < results.size(); ++p)
      {
        const SweepResult       &result = results[p];
        std::vector<std::string> row    = {plan.points()[p].folder};
        for (const std::string &value : plan.points()[p].values)
          row.push_back(value);
        row.push_back(result.status);
        for (const Quantity &quantity : quantities)
          {
            const auto value = error(p, quantity);
            const auto found = result.errors.find(quantity.name);
            row.push_back(value ? Text::from_number(*value) : "");
            row.push_back(three_decimals(order(p, quantity)));
            row.push_back(found == result.errors.end()
                            ? ""
                            : std::to_string(found->second.instants));
          }
        for (const std::string &name : cost_names())
          row.push_back(
            result.costs.contains(name) ? result.costs.at(name).dump() : "");
        row.push_back(result.message);
        text += csv_row(row);
      }
    return text;
  }



  Summary
  SweepTable::json() const
  {
    Summary json;
    json["title"]      = title;
    json["parameters"] = plan.parameters();
    for (const Quantity &quantity : quantities)
      json["quantities"].push_back(quantity.name);
    json["reference"]["description"] = reference;
    if (reference_result)
      json["reference"]["costs"] = reference_result->costs;
    json["points"] = Summary::array();
    for (std::size_t p = 0; p < results.size(); ++p)
      {
        Summary point;
        point["folder"] = plan.points()[p].folder;
        for (std::size_t k = 0; k < plan.parameters().size(); ++k)
          point["values"][plan.parameters()[k]] = plan.points()[p].values[k];
        point.update(results[p].to_json());
        json["points"].push_back(point);
      }
    return json;
  }
} // namespace Crevasse
