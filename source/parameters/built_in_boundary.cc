// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/parameters/built_in_boundary.h>

#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    FixedPoint<dim>
    free_point(const double x, const double z)
    {
      FixedPoint<dim> fixed_point;
      fixed_point.components.fill(false);
      fixed_point.point[0] = x;
      if (dim == 3)
        fixed_point.point[dim - 1] = z;
      return fixed_point;
    }
  } // namespace



  std::map<unsigned int, std::string>
  built_in_names(const GeometryParameters &parameters, const unsigned int dim)
  {
    const bool has_crack = traits(parameters.shape).has_crack;
    std::map<unsigned int, std::string> names = {
      {BoundaryIds::left, "left"},
      {BoundaryIds::right, "right"},
      {BoundaryIds::ligament, has_crack ? "ligament" : "bottom"},
      {BoundaryIds::top, "top"}};
    if (has_crack)
      names[BoundaryIds::lip] = "lip";
    if (dim == 3)
      names.insert(
        {{BoundaryIds::front, "front"}, {BoundaryIds::back, "back"}});
    return names;
  }



  double
  tip_abscissa(const GeometryParameters &parameters)
  {
    return parameters.shape == Shape::edge_crack
             ? parameters.width - parameters.crack_length
             : parameters.crack_length;
  }



  BoundaryRoles
  resolve_roles(const BoundaryParameters &parameters,
                const BoundaryRoles      &automatic)
  {
    BoundaryRoles                roles;
    std::set<types::boundary_id> named, no_lips;
    for (const BoundaryRole &role : boundary_role_table)
      {
        const auto &ids = (parameters.*role.list)->ids;
        named.insert(ids.begin(), ids.end());
        if (role.ids != &BoundaryRoles::loaded)
          no_lips.insert(ids.begin(), ids.end());
        roles.*role.ids = ids;
      }
    for (const BoundaryRole &role : boundary_role_table)
      {
        const auto &taken = role.is_lip ? no_lips : named;
        auto       &ids   = roles.*role.ids;
        if ((parameters.*role.list)->is_automatic)
          std::set_difference((automatic.*role.ids).begin(),
                              (automatic.*role.ids).end(),
                              taken.begin(),
                              taken.end(),
                              std::inserter(ids, ids.end()));
        if (role.is_lip) // a lip with contact is not an open crack as well
          no_lips.insert(ids.begin(), ids.end());
      }
    roles.has_friction = roles.has_contact() &&
                         parameters.friction.is_valid() &&
                         !are_zero(formulas_of(parameters.friction));
    return roles;
  }



  BoundaryRoles
  built_in_roles(const GeometryParameters &parameters)
  {
    BoundaryRoles roles;
    if (parameters.shape == Shape::mesh_file)
      return roles;

    roles.symmetry = {BoundaryIds::ligament};
    roles.loaded   = {BoundaryIds::top};
    if (traits(parameters.shape).has_crack)
      roles.contact = roles.open = {BoundaryIds::lip};
    if (parameters.shape == Shape::centre_crack)
      roles.symmetry.insert(BoundaryIds::left);
    return roles;
  }



  template <int dim>
  std::vector<FixedPoint<dim>>
  built_in_fixed_points(const GeometryParameters &parameters,
                        const BoundaryRoles      &roles)
  {
    if (parameters.shape == Shape::mesh_file || !roles.clamped.empty())
      return {};

    // A plane of symmetry suppresses the translation along its normal, and
    // every rotation except that about its normal.
    const auto is_imposed = [&roles](const unsigned int component) {
      for (const auto id : roles.displaced)
        if (roles.free.count({id, component}) == 0)
          return true;
      return false;
    };
    const bool slides_along = roles.symmetry.count(BoundaryIds::left) == 0 &&
                              roles.symmetry.count(BoundaryIds::right) == 0 &&
                              !is_imposed(0);
    const bool slides_across = dim == 3 && !is_imposed(2) &&
                               roles.symmetry.count(BoundaryIds::front) == 0 &&
                               roles.symmetry.count(BoundaryIds::back) == 0;
    if (!slides_along && !slides_across)
      return {};

    // As in the paper, the crack tip is fixed.
    const double x =
      traits(parameters.shape).has_crack ? tip_abscissa(parameters) : 0.;
    FixedPoint<dim> first = free_point<dim>(x, 0.);
    first.components[0]   = slides_along;
    if (dim == 3)
      first.components[dim - 1] = slides_across;
    if (!slides_along || !slides_across)
      return {first};

    // The body could still rotate in the crack plane.
    FixedPoint<dim> second = free_point<dim>(x, parameters.thickness);
    second.components[0]   = true;
    return {first, second};
  }



  template decltype(built_in_fixed_points<2>) built_in_fixed_points<2>;
  template decltype(built_in_fixed_points<3>) built_in_fixed_points<3>;
} // namespace Crevasse
