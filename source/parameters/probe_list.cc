// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/parameters/probe_list.h>

#include <deal.II/base/utilities.h>

namespace Crevasse
{
  namespace
  {
    void
    check_name(const std::string &name)
    {
      const std::string allowed =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
      if (name.empty() || name.find_first_not_of(allowed) != std::string::npos)
        throw SceneError("the probe name \"" + Text::shorten(name) +
                         "\" must consist of letters a-z, digits, \"_\" and "
                         "\"-\", because it becomes a file name");
    }
  } // namespace



  std::vector<NamedPoint>
  parse_probes(const std::string &text)
  {
    std::vector<NamedPoint> probes;
    std::set<std::string>   names;
    if (text == "automatic")
      return probes;
    for (const std::string &entry : Text::split(text, ';'))
      {
        const std::size_t colon = entry.find(':');
        if (colon == std::string::npos)
          throw SceneError("\"" + Text::shorten(entry) +
                           "\" must be \"name: x, y\", in three dimensions "
                           "\"name: x, y, z\"; probes are separated by "
                           "semicolons");
        const std::string name =
          dealii::Utilities::trim(entry.substr(0, colon));
        check_name(name);
        if (!names.insert(name).second)
          throw SceneError("the probe name \"" + name +
                           "\" must be that of one probe only");
        probes.push_back({name, parse_coordinates(entry.substr(colon + 1))});
      }
    return probes;
  }



  std::vector<double>
  parse_coordinates(const std::string &text)
  {
    const auto coordinates = Text::to_numbers(text);
    if (!coordinates)
      throw SceneError("\"" + Text::shorten(dealii::Utilities::trim(text)) +
                       "\" must be coordinates, separated by commas");
    return *coordinates;
  }



  template <int dim>
  dealii::Point<dim>
  to_point(const std::vector<double> &coordinates)
  {
    std::vector<std::string> numbers;
    for (const double coordinate : coordinates)
      numbers.push_back(Text::from_number(coordinate));
    if (numbers.size() != dim)
      throw SceneError("\"" + Text::join(numbers, ", ") + "\" must be " +
                       std::to_string(dim) +
                       " coordinates, separated by commas");
    dealii::Point<dim> point;
    std::copy(coordinates.begin(), coordinates.end(), point.begin_raw());
    return point;
  }



  template decltype(to_point<2>) to_point<2>;
  template decltype(to_point<3>) to_point<3>;
} // namespace Crevasse
