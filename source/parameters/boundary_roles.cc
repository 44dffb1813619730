// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/parameters/boundary_roles.h>

#include <deal.II/base/utilities.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    Point<dim>
    parse_point(const std::string &text)
    {
      const auto coordinates = Text::to_numbers(text);
      if (!coordinates || coordinates->size() != dim)
        throw SceneError("\"" + Text::shorten(text) + "\" must be " +
                         std::to_string(dim) +
                         " coordinates, separated by commas");
      Point<dim> point;
      for (unsigned int d = 0; d < dim; ++d)
        point[d] = (*coordinates)[d];
      return point;
    }



    template <int dim>
    std::array<bool, dim>
    parse_components(const std::string &text)
    {
      std::array<bool, dim> components;
      components.fill(false);

      const std::vector<std::string> parts = Text::split(text, ',');
      for (const std::string &part : parts)
        {
          const auto component = Text::to_unsigned(part);
          if (!component || *component < 1 || *component > dim)
            throw SceneError("\"" + Text::shorten(part) +
                             "\" must be the number of a component, 1 to " +
                             std::to_string(dim));
          components[*component - 1] = true;
        }
      if (parts.empty())
        throw SceneError(
          "the numbers of the fixed components must follow the "
          "colon, as in \"0, 0: 1\"");
      return components;
    }
  } // namespace



  template <int dim>
  std::vector<FixedPoint<dim>>
  parse_fixed_points(const std::string &text)
  {
    const std::string trimmed = Utilities::trim(text);
    if (trimmed == "automatic" || trimmed == "none")
      return {};

    std::vector<FixedPoint<dim>> fixed_points;
    for (const std::string &entry : Text::split(trimmed, ';'))
      {
        const std::size_t colon = entry.find(':');
        FixedPoint<dim>   fixed_point;
        fixed_point.point = parse_point<dim>(entry.substr(0, colon));
        if (colon == std::string::npos)
          fixed_point.components.fill(true);
        else
          fixed_point.components =
            parse_components<dim>(entry.substr(colon + 1));
        fixed_points.push_back(fixed_point);
      }
    return fixed_points;
  }



  std::optional<std::set<types::boundary_id>>
  parse_boundary_ids(const std::string &text)
  {
    const std::string trimmed = Utilities::trim(text);
    if (trimmed == "automatic")
      return {};

    std::set<types::boundary_id> ids;
    if (trimmed == "none")
      return ids;

    for (const std::string &part : Text::split(trimmed, ','))
      {
        const auto id = Text::to_unsigned(part);
        if (!id || *id == numbers::internal_face_boundary_id)
          throw SceneError(
            "must be \"automatic\", \"none\" or boundary ids "
            "(integers of at least 0) separated by commas; with a Gmsh file "
            "also names of physical groups");
        ids.insert(*id);
      }
    return ids;
  }



  BoundaryRoles
  resolve_roles(const BoundaryParameters &parameters,
                const BoundaryRoles      &automatic)
  {
    using Ids = std::set<types::boundary_id>;

    const auto clamped  = parse_boundary_ids(parameters.clamped);
    const auto symmetry = parse_boundary_ids(parameters.symmetry);
    const auto loaded   = parse_boundary_ids(parameters.loaded);
    const auto contact  = parse_boundary_ids(parameters.contact);

    Ids named;
    for (const auto *ids : {&clamped, &symmetry, &loaded, &contact})
      if (*ids)
        named.insert((*ids)->begin(), (*ids)->end());

    const auto resolve = [&named](const std::optional<Ids> &own, Ids ids) {
      if (own)
        return *own;
      for (const types::boundary_id id : named)
        ids.erase(id);
      return ids;
    };

    BoundaryRoles roles;
    roles.clamped  = resolve(clamped, automatic.clamped);
    roles.symmetry = resolve(symmetry, automatic.symmetry);
    roles.loaded   = resolve(loaded, automatic.loaded);
    roles.contact  = resolve(contact, automatic.contact);
    return roles;
  }



  template std::vector<FixedPoint<2>>
  parse_fixed_points<2>(const std::string &);
  template std::vector<FixedPoint<3>>
  parse_fixed_points<3>(const std::string &);
} // namespace Crevasse
