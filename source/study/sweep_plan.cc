// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/parameters/scene.h>
#include <crevasse/study/sweep_plan.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdio>
#include <set>

namespace Crevasse
{
  namespace
  {
    constexpr const char *form =
      "must have the form \"Section/Name=a,b,c\", with \";\" between values "
      "that contain commas, \" | \" between values that contain both, and \" & "
      "\" between parameters that change "
      "together";



    std::string
    quote_vary(const std::string &text)
    {
      return "--vary \"" + Text::shorten(text) + "\": ";
    }



    /** The parts of a text between the separators. */
    std::vector<std::string>
    parts_of(const std::string &text, const std::string &separator)
    {
      std::vector<std::string> parts;
      std::size_t              begin = 0;
      for (std::size_t end = text.find(separator); end != std::string::npos;
           end             = text.find(separator, begin))
        {
                      parts.push_back(text.substr(begin, end - begin));
                      begin = end + separator.size();
        }
      parts.push_back(text.substr(begin));
      return parts;
    }



    /** The same name for what read_override takes for the same parameter. */
    std::string
    parameter_name(const std::string &text)
    {
      const std::size_t slash = text.rfind('/');
      return slash == std::string::npos
               ? Text::squeeze(text)
               : Text::squeeze(text.substr(0, slash)) + '/' +
                   Text::squeeze(text.substr(slash + 1));
    }



    /** Cuts at the rarest separator that there is: a value may contain those
     * before it. */
    std::vector<std::string>
    list_of_values(const std::string &list)
    {
      const std::string bar = " | ";
      if (list.find(bar) == std::string::npos)
        return Text::split(list,
                           list.find(';') == std::string::npos ? ',' : ';');
      std::vector<std::string> values;
      for (const std::string &value : parts_of(list, bar))
        values.push_back(Text::squeeze(value));
      return values;
    }



    /** Adds one "Section/Name=a,b,c" to an axis. */
    void
    read_values(const std::string &option,
                const std::string &text,
                SweepAxis         &axis,
                Problems          &problems)
    {
      const std::size_t equals = text.find('=');
      const std::string name   = parameter_name(text.substr(0, equals));
      if (equals == std::string::npos || name.empty())
        {
          problems.add(quote_vary(option) + form);
          return;
        }
      const std::string              list   = text.substr(equals + 1);
      const std::vector<std::string> values = list_of_values(list);
      if (values.empty() ||
          std::find(values.begin(), values.end(), "") != values.end())
        problems.add(quote_vary(option) + name + " lacks a value; it " + form);
      axis.parameters.push_back(name);
      axis.values.push_back(values);
    }



    SweepAxis
    read_axis(const std::string &option, Problems &problems)
    {
      SweepAxis axis;
      for (const std::string &text : parts_of(option, " & "))
        read_values(option, text, axis, problems);
      for (std::size_t k = 1; k < axis.values.size(); ++k)
        if (axis.values[k].size() != axis.values[0].size())
          problems.add(quote_vary(option) + axis.parameters[0] + " has " +
                       std::to_string(axis.values[0].size()) + " values, but " +
                       axis.parameters[k] + " has " +
                       std::to_string(axis.values[k].size()) +
                       ": parameters that change together must have as many");
      return axis;
    }



    /** Eight hexadecimal digits that tell texts apart (FNV-1a). */
    std::string
    digest(const std::string &text)
    {
      std::uint32_t hash = 2166136261u;
      for (const unsigned char c : text)
        hash = (hash ^ c) * 16777619u;
      char digits[9];
      std::snprintf(digits, sizeof(digits), "%08x", unsigned(hash));
      return digits;
    }



    /** A folder name that says what varies, and stays the same if more values
     * are added to a list. */
    std::string
    folder_name(const std::vector<std::string> &parameters,
                const std::vector<std::string> &values)
    {
      constexpr std::size_t longest = 80;
      std::string           name, all;
      bool                  faithful = true;
      for (std::size_t k = 0; k < parameters.size(); ++k)
        {
          const std::string &parameter = parameters[k];
          const std::string  short_name =
            parameter.substr(parameter.rfind('/') + 1);
          for (const char c : short_name)
            name += std::isalnum(static_cast<unsigned char>(c))
                      ? char(std::tolower(static_cast<unsigned char>(c)))
                      : '_';
          name += '_';
          for (const char c : values[k])
            {
              const bool usual = std::isalnum(static_cast<unsigned char>(c)) ||
                                 c == '.' || c == '-' || c == '+' || c == ' ';
              faithful = faithful && usual;
              name += usual && c != ' ' ? c : '_';
            }
          name += k + 1 < parameters.size() ? "__" : "";
          all += parameter + '=' + values[k] + '\n';
        }
      return faithful && name.size() <= longest
               ? name
               : name.substr(0, longest) + "__" + digest(all);
    }



    /** As numbers, if all are positive and different. */
    std::vector<double>
    numbers_of(const std::vector<std::string> &texts)
    {
      std::vector<double> numbers;
      std::set<double>    different;
      for (const std::string &text : texts)
        {
          const auto number = Text::to_number(text);
          if (!number || *number <= 0. || !different.insert(*number).second)
            return {};
          numbers.push_back(*number);
        }
      return numbers;
    }



    std::vector<double>
    numbers_of(const SweepAxis &axis)
    {
      for (const auto &texts : axis.values)
        if (const auto numbers = numbers_of(texts); numbers.size() > 1)
          return numbers;
      return {};
    }
  } // namespace



  std::size_t
  SweepAxis::size() const
  {
    return values[0].size();
  }



  SweepPlan::SweepPlan(const SweepRequest &request)
  {
    Problems problems;
    if (request.vary.empty())
      problems.add(
        "A sweep needs a list of values: --vary "
        "\"Section/Name=a,b,c\"");
    for (const std::string &option : request.vary)
      {
        all_axes.push_back(read_axis(option, problems));
        for (const std::string &name : all_axes.back().parameters)
          {
            if (std::find(names.begin(), names.end(), name) != names.end())
              problems.add(quote_vary(option) + name +
                           " is varied twice; parameters that change together "
                           "belong into one --vary");
            if (name == "Output directory")
              problems.add(quote_vary(option) +
                           "each point has a folder of its own below --output");
            names.push_back(name);
          }
      }
    problems.throw_if_any();
    make_points();
  }



  void
  SweepPlan::make_points()
  {
    std::size_t n = 1;
    for (const SweepAxis &axis : all_axes)
      n *= axis.size();
    for (std::size_t number = 0; number < n; ++number)
      {
        SweepPoint point;
        point.indices.resize(all_axes.size());
        std::size_t rest = number;
        for (std::size_t a = all_axes.size(); a-- > 0;)
          {
            point.indices[a] = rest % all_axes[a].size();
            rest /= all_axes[a].size();
          }
        for (std::size_t a = 0; a < all_axes.size(); ++a)
          for (const auto &values : all_axes[a].values)
            point.values.push_back(values[point.indices[a]]);
        point.folder = folder_name(names, point.values);
        all_points.push_back(point);
      }
  }



  const std::vector<SweepAxis> &
  SweepPlan::axes() const
  {
    return all_axes;
  }



  const std::vector<std::string> &
  SweepPlan::parameters() const
  {
    return names;
  }



  std::vector<std::string>
  SweepPlan::parameters_of_problem() const
  {
    static const std::set<std::string> of_mesh  = {"Subdivisions",
                                                   "Refinements"};
    static const std::set<std::string> sections = {GeometryParameters::section,
                                                   BoundaryParameters::section,
                                                   MaterialParameters::section,
                                                   LoadParameters::section};
    std::vector<std::string>           found;
    for (const std::string &name : names)
      {
        const auto slash = name.find('/');
        if (sections.count(name.substr(0, slash)) > 0 &&
            of_mesh.count(name.substr(slash + 1)) == 0)
          found.push_back(name);
      }
    return found;
  }



  const std::vector<SweepPoint> &
  SweepPlan::points() const
  {
    return all_points;
  }



  std::vector<Override>
  SweepPlan::overrides(const SweepPoint &point) const
  {
    std::vector<Override> all;
    for (std::size_t k = 0; k < names.size(); ++k)
      all.push_back({names[k] + '=' + point.values[k], "--vary"});
    return all;
  }



  std::size_t
  SweepPlan::main_axis() const
  {
    std::size_t best = all_axes.size(), most = 1;
    for (std::size_t a = 0; a < all_axes.size(); ++a)
      if (const std::size_t n = numbers_of(all_axes[a]).size(); n > most)
        {
          best = a;
          most = n;
        }
    return best;
  }



  std::vector<double>
  SweepPlan::main_numbers() const
  {
    const std::size_t axis = main_axis();
    return axis < all_axes.size() ? numbers_of(all_axes[axis])
                                  : std::vector<double>();
  }
} // namespace Crevasse
