// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/parameters/boundary_roles.h>
#include <crevasse/parameters/probe_list.h>

#include <deal.II/base/utilities.h>

namespace Crevasse
{
  using namespace dealii;

  BoundaryList
  parse_boundary_list(const std::string &text)
  {
    const std::string trimmed = Utilities::trim(text);
    BoundaryList      list;
    list.is_automatic = trimmed == "automatic";
    if (list.is_automatic || trimmed == "none")
      return list;
    for (const std::string &part : Text::split(trimmed, ','))
      {
        const auto id = Text::to_unsigned(part);
        if (id && *id != numbers::internal_face_boundary_id)
          list.ids.insert(*id);
        else if (Text::to_number(part) || part == "automatic" || part == "none")
          throw SceneError(
            "must be \"automatic\", \"none\" or boundary ids "
            "(integers of at least 0) separated by commas; with a Gmsh file "
            "also names of physical groups");
        else
          list.names.push_back(Text::squeeze(part));
      }
    return list;
  }



  FixedPointList
  parse_fixed_points(const std::string &text)
  {
    const std::string trimmed = Utilities::trim(text);
    FixedPointList    list;
    list.is_automatic = trimmed == "automatic";
    if (list.is_automatic || trimmed == "none")
      return list;
    for (const std::string &part : Text::split(trimmed, ';'))
      {
        const std::size_t     colon = part.find(':');
        FixedPointList::Entry entry;
        entry.coordinates = parse_coordinates(part.substr(0, colon));
        if (colon != std::string::npos)
          for (const auto &number : Text::split(part.substr(colon + 1), ','))
            entry.components.insert(Text::to_unsigned(number).value_or(0));
        if (entry.components.count(0) > 0 ||
            (colon != std::string::npos && entry.components.empty()))
          throw SceneError("\"" + Text::shorten(part) +
                           "\": after the colon the numbers of components "
                           "must follow, from 1 on, as in \"0, 0: 1\"");
        list.entries.push_back(entry);
      }
    return list;
  }



  template <int dim>
  std::vector<FixedPoint<dim>>
  to_fixed_points(const FixedPointList &list)
  {
    std::vector<FixedPoint<dim>> fixed_points;
    for (const auto &[coordinates, components] : list.entries)
      {
        FixedPoint<dim> fixed_point{to_point<dim>(coordinates), {}};
        fixed_point.components.fill(components.empty());
        for (const unsigned int component : components)
          if (component > dim)
            throw SceneError("\"" + std::to_string(component) +
                             "\" must be the number of a component, 1 to " +
                             std::to_string(dim));
          else
            fixed_point.components[component - 1] = true;
        fixed_points.push_back(fixed_point);
      }
    return fixed_points;
  }



  template decltype(to_fixed_points<2>) to_fixed_points<2>;
  template decltype(to_fixed_points<3>) to_fixed_points<3>;
} // namespace Crevasse
