// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/parameters/probe_list.h>

#include <deal.II/base/utilities.h>

#include <set>

namespace Crevasse
{
  namespace
  {
    void
    check_name(const std::string &name)
    {
      const std::string allowed =
        "abcdefghijklmnopqrstuvwxyz"
        "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
        "0123456789_-";
      if (name.empty() || name.find_first_not_of(allowed) != std::string::npos)
        throw SceneError("the probe name \"" + Text::shorten(name) +
                         "\" must consist of letters a-z, digits, \"_\" and "
                         "\"-\", because it becomes a file name");
    }



    NamedPoint
    parse_probe(const std::string &entry)
    {
      const std::size_t colon       = entry.find(':');
      const auto        coordinates = colon == std::string::npos
                                        ? std::nullopt
                                        : Text::to_numbers(entry.substr(colon + 1));
      if (!coordinates)
        throw SceneError("\"" + Text::shorten(entry) +
                         "\" must be \"name: x, y\", in three dimensions "
                         "\"name: x, y, z\"; probes are separated by "
                         "semicolons");
      const std::string name = dealii::Utilities::trim(entry.substr(0, colon));
      check_name(name);
      return {name, *coordinates};
    }
  } // namespace



  std::vector<NamedPoint>
  parse_probes(const std::string &text)
  {
    std::vector<NamedPoint> probes;
    std::set<std::string>   names;
    for (const std::string &entry : Text::split(text, ';'))
      {
        probes.push_back(parse_probe(entry));
        if (!names.insert(probes.back().name).second)
          throw SceneError("the name \"" + probes.back().name +
                           "\" must stand for one probe only");
      }
    return probes;
  }



  template <int dim>
  std::vector<Probe<dim>>
  to_probes(const std::vector<NamedPoint> &points)
  {
    std::vector<Probe<dim>> probes;
    for (const NamedPoint &point : points)
      {
        std::vector<std::string> numbers;
        for (const double coordinate : point.coordinates)
          numbers.push_back(Text::from_number(coordinate));
        if (numbers.size() != dim)
          throw SceneError(
            "\"" + point.name + ": " + Text::join(numbers, ", ") +
            "\" must be \"name: " + (dim == 2 ? "x, y" : "x, y, z") +
            "\"; probes are separated by semicolons");
        Probe<dim> probe{point.name, {}};
        for (unsigned int d = 0; d < dim; ++d)
          probe.point[d] = point.coordinates[d];
        probes.push_back(probe);
      }
    return probes;
  }



  template std::vector<Probe<2>>
  to_probes<2>(const std::vector<NamedPoint> &);
  template std::vector<Probe<3>>
  to_probes<3>(const std::vector<NamedPoint> &);
} // namespace Crevasse
