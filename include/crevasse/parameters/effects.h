// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_effects_h
#define crevasse_parameters_effects_h

#include <crevasse/parameters/boundary_roles.h>
#include <crevasse/parameters/scene.h>

#include <string>
#include <vector>

namespace Crevasse
{
  /** Which effects a scene calls for, decided once, each with its reason. What
   * is off is not created: it costs neither time nor memory. */
  struct Effects
  {
    struct Effect
    {
      std::string name;
      bool        on = false;
      std::string why;
    };

    Effect contact;
    Effect viscosity;
    Effect secular_flow; ///< off until somebody who knows the loads decides
    Effect chain;
    /** Those of MaterialParameters::free_strains(). */
    std::vector<Effect> free_strains;
    Effect              varying_stiffness; ///< by a factor or freely
    Effect              varying_viscosity;
    Effect              body_force;
    Effect              singular_functions;
    Effect              stress_intensity;
    Effect              field_output;

    /** @param temperature_varies whether [Loads] Temperature does in time. */
    Effects(const Scene         &scene,
            const BoundaryRoles &roles,
            const bool           temperature_varies);

    bool
    has_free_strain() const;

    /** All of them, in a fixed order, for tables. */
    std::vector<Effect>
    list() const;
  };
} // namespace Crevasse

#endif
