// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#include <crevasse/scene/effects.h>
#include <crevasse/scene/expression.h>

#include <algorithm>

namespace Crevasse
{
  Effects::Effects(const Scene &scene, const BoundaryRoles &roles)
  {
    contact.name = "contact";
    contact.on   = !roles.contact.empty();
    contact.why  = contact.on ? "a boundary has the role Contact"
                              : "no boundary has the role Contact";

    viscosity.name = "viscosity";
    viscosity.on   = scene.material.viscosity != "none";
    viscosity.why  = "[Material] Viscosity = " + scene.material.viscosity;

    const std::vector<Expression> force =
      Expression::parse_list(scene.loads.body_force);
    body_force.name = "body force";
    body_force.on =
      std::any_of(force.begin(), force.end(), [](const Expression &component) {
        return !component.is_zero();
      });
    body_force.why =
      "[Loads] Body force " +
      (force.empty() ? "is not set" : "= " + scene.loads.body_force);

    field_output.name = "field output";
    field_output.on   = scene.output.fields != "none";
    field_output.why  = "[Output] Fields = " + scene.output.fields;
  }



  std::vector<Effects::Effect>
  Effects::list() const
  {
    return {contact, viscosity, body_force, field_output};
  }
} // namespace Crevasse
