// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/model/body.h>
#include <crevasse/parameters/probe_list.h>
#include <crevasse/study/quantity.h>

#include <algorithm>

namespace Crevasse
{
  namespace
  {
    void
    add_probe_names(const Scene &scene, std::vector<std::string> &names)
    {
      for (const NamedPoint &probe : *scene.output.probes)
        if (std::find(names.begin(), names.end(), probe.name) == names.end())
          names.push_back(probe.name);
    }



    std::vector<std::string>
    probe_names(const std::vector<const Scene *> &scenes)
    {
      std::vector<std::string> names;
      for (const Scene *scene : scenes)
        add_probe_names(*scene, names);
      return names;
    }



    const std::vector<std::string> &
    probe_columns()
    {
      static const std::vector<std::string> columns = {"u",
                                                       "s",
                                                       "u_1",
                                                       "u_2",
                                                       "u_3",
                                                       "s_11",
                                                       "s_22",
                                                       "s_33",
                                                       "s_12",
                                                       "s_13",
                                                       "s_23",
                                                       "opening",
                                                       "pressure"};
      return columns;
    }



    /** Which columns a table of this name has; none if there is no such. */
    std::vector<std::string>
    columns_of(const std::string &table, const std::vector<std::string> &probes)
    {
      for (const std::string &probe : probes)
        if (table == "probe_" + probe)
          return probe_columns();
      if (table == "contact")
        return {"force", "largest_pressure", "closed_nodes"};
      if (table == "periods")
        return {"stress_change"};
      if (table == "load_work")
        return {"load_work"};
      if (table == "crack_tip")
        return {"K_I",
                "K_I_stress",
                "K_I_error",
                "energy_release_rate",
                "strain_energy"};
      return {};
    }



    /** What is wrong with the name of a quantity, or nothing. */
    std::string
    problem_of(const Quantity &quantity, const std::vector<std::string> &probes)
    {
      if (quantity.is_stress_field())
        return "";
      const auto        columns = columns_of(quantity.table(), probes);
      const std::string column  = quantity.column();
      if (!columns.empty() && quantity.name.find('/') != std::string::npos)
        return std::find(columns.begin(), columns.end(), column) ==
                   columns.end()
                 ? "has no column \"" + Text::shorten(column) +
                     "\"; columns are: " + Text::join(columns, ", ")
                 : "";
      std::vector<std::string> tables = {"contact",
                                         "periods",
                                         "load_work",
                                         "crack_tip"};
      for (const std::string &probe : probes)
        tables.push_back("probe_" + probe);
      return "is no quantity; allowed are \"stress\" and \"TABLE/COLUMN\" "
             "with a table of: " +
             Text::join(tables, ", ") +
             Text::did_you_mean(quantity.table(), tables);
    }



    Quantity *
    find(std::vector<Quantity> &quantities, const std::string &name)
    {
      for (Quantity &quantity : quantities)
        if (quantity.name == name)
          return &quantity;
      return nullptr;
    }



    std::vector<Quantity>
    default_quantities(const std::vector<std::string>   &probes,
                       const std::vector<const Scene *> &scenes)
    {
      std::vector<Quantity> all = {{"stress", nullptr}};
      for (const std::string &probe : probes)
        {
          all.push_back({"probe_" + probe + "/u", nullptr});
          all.push_back({"probe_" + probe + "/s", nullptr});
        }
      if (!boundary_roles(*scenes.front()).contact.empty())
        all.push_back({"contact/force", nullptr});
      return all;
    }



    std::vector<Quantity>
    listed_quantities(const SweepRequest             &request,
                      const std::vector<std::string> &probes,
                      Problems                       &problems)
    {
      std::vector<Quantity> all;
      for (const std::string &name : Text::split(request.error, ','))
        {
          const std::string problem = problem_of({name, nullptr}, probes);
          if (!problem.empty())
            problems.add("--error " + Text::shorten(name) + ": " + problem);
          else if (find(all, name) == nullptr)
            all.push_back({name, nullptr});
        }
      return all;
    }



    /** Why a quantity cannot be compared with a formula, or nothing. */
    std::string
    problem_with_formula(const Quantity &quantity)
    {
      const std::string column = quantity.column();
      if (quantity.is_stress_field() || quantity.table() == "periods" ||
          column == "u" || column == "s")
        return "a formula can only stand for one column over time";
      if (quantity.exact->depends_on_space())
        return "a formula may depend on t, but not on x, y, z";
      return "";
    }



    /** Gives a quantity its closed form, and adds it where it is new. */
    void
    read_exact(const std::string              &text,
               const std::vector<std::string> &probes,
               std::vector<Quantity>          &all,
               Problems                       &problems)
    {
      const std::string where  = "--exact \"" + Text::shorten(text) + "\": ";
      const std::size_t equals = text.find('=');
      Quantity    quantity{Text::squeeze(text.substr(0, equals)), nullptr};
      std::string problem = problem_of(quantity, probes);
      if (equals == std::string::npos)
        problem = "must have the form \"QUANTITY=formula of t\"";
      if (problem.empty())
        try
          {
            quantity.exact = std::make_shared<const Expression>(
              text.substr(equals + 1),
              Expression::Variables::space_and_time,
              "--exact " + quantity.name);
            problem = problem_with_formula(quantity);
          }
        catch (const SceneError &error)
          {
            problem = error.what();
          }
      Quantity *known = find(all, quantity.name);
      if (problem.empty() && known != nullptr && known->exact != nullptr)
        problem = "has two closed forms";
      if (!problem.empty())
        problems.add(where + problem);
      else if (known != nullptr)
        known->exact = quantity.exact;
      else
        all.push_back(quantity);
    }
  } // namespace



  bool
  Quantity::is_stress_field() const
  {
    return name == "stress";
  }



  std::string
  Quantity::table() const
  {
    return name.substr(0, name.find('/'));
  }



  std::string
  Quantity::column() const
  {
    return name.substr(name.find('/') + 1);
  }



  bool
  Quantity::selects(const std::string &other) const
  {
    const std::string own = column();
    return other == own ||
           ((own == "u" || own == "s") && other.compare(0, 2, own + '_') == 0);
  }



  std::vector<Quantity>
  choose_quantities(const SweepRequest               &request,
                    const std::vector<const Scene *> &scenes)
  {
    const std::vector<std::string> probes = probe_names(scenes);
    Problems                       problems;
    std::vector<Quantity>          all =
      request.error.empty() && !request.reference.empty()
                 ? default_quantities(probes, scenes)
                 : listed_quantities(request, probes, problems);
    for (const std::string &text : request.exact)
      read_exact(text, probes, all, problems);
    problems.throw_if_any();

    for (const Quantity &quantity : all)
      if (quantity.exact == nullptr && request.reference.empty())
        throw SceneError(
          "There is nothing to compare " + quantity.name +
          " with: give a run that is accurate enough, --reference "
          "\"Section/Name=value\", or a closed form, --exact \"" +
          quantity.name + "=formula of t\".");
    if (all.empty())
      throw SceneError(
        "There is nothing to compare with: give a run that is accurate "
        "enough, --reference \"Section/Name=value\", or closed forms, --exact "
        "\"probe_NAME/COLUMN=formula of t\".");
    return all;
  }
} // namespace Crevasse
