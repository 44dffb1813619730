// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/parameters/built_in_boundary.h>
#include <crevasse/parameters/checker.h>
#include <crevasse/parameters/effects.h>
#include <crevasse/parameters/scene.h>

namespace Crevasse
{
  namespace
  {
    void
    check_friction(const Scene         &scene,
                   const BoundaryRoles &roles,
                   Problems            &problems)
    {
      const std::string reason = " with [Boundary] Friction coefficient = " +
                                 scene.boundary.friction.text();
      const Checker boundary(BoundaryParameters::section, problems);
      boundary.demand(
        roles.contact.empty() || scene.geometry.shape == Shape::mesh_file,
        "Friction coefficient",
        "must be 0 for a built-in shape: its crack lies in a plane "
        "of symmetry, where nothing slides; use a mesh file with "
        "[Boundary] Crack");
      std::set<dealii::types::boundary_id> lips = roles.contact;
      lips.insert(roles.crack.begin(), roles.crack.end());
      check_boundaries(boundary,
                       "Friction coefficient",
                       scene.boundary.friction,
                       "Crack or Contact",
                       lips);
      boundary.demand(!depend_on("theta",
                                 formulas_of(scene.boundary.friction)) ||
                        has_temperature(scene.loads),
                      "Friction coefficient",
                      "must not depend on theta without [Loads] Temperature");
      const Checker tip(CrackTipParameters::section, problems);
      tip.demand(scene.crack_tip.method != StressIntensityMethod::williams_fit,
                 "Method",
                 "must not be williams fit" + reason +
                   ": it is for lips without shear; use automatic");
      tip.demand(!scene.crack_tip.creep_integral,
                 "Creep integral",
                 "must be false" + reason +
                   ", which the integral does not include");
      const Checker geometry(GeometryParameters::section, problems);
      geometry.demand(!scene.geometry.crack_growth.is_valid() ||
                        scene.geometry.crack_growth->empty(),
                      "Crack growth",
                      "must be empty" + reason);
      const Checker time(TimeIntegrationParameters::section, problems);
      time.demand(
        !traits(scene.time_integration.scheme).has(Trait::is_of_arkode),
        "Scheme",
        "must not be one of ARKODE" + reason +
          ", which interpolates over steps, across the instants at which lips "
          "begin to slide; use automatic, heun, rk4 or sdirk2");
      const Checker refinement(RefinementParameters::section, problems);
      refinement.demand(
        scene.refinement.strategy != RefinementStrategy::adaptive,
        "Strategy",
        "must not be adaptive" + reason +
          ": the slip of pairs of nodes is not carried from mesh to "
          "mesh; use tip or uniform");
    }
  } // namespace



  void
  check_roles(const Scene &scene, Problems &problems)
  {
    for (const BoundaryRole &role : boundary_role_table)
      if (!(scene.boundary.*role.list).is_valid())
        return;
    const BoundaryRoles roles =
      resolve_roles(scene.boundary, built_in_roles(scene.geometry));
    scene.loads.check_boundaries(roles, problems);
    if (roles.has_friction)
      check_friction(scene, roles, problems);
    const std::string reason =
      "with [Boundary] Displaced, the motion of which it does not include";
    const bool is_displaced = !roles.displaced.empty();
    Checker(OutputParameters::section, problems)
      .demand(!is_displaced || !scene.output.load_work,
              "Load work",
              "must be false " + reason);
    const bool    loads_lips = roles.has_loaded_lip();
    const Checker crack_tip(CrackTipParameters::section, problems);
    crack_tip.demand(!loads_lips || scene.crack_tip.method !=
                                      StressIntensityMethod::williams_fit,
                     "Method",
                     "williams fit is for lips without load; use automatic");
    crack_tip.demand(!loads_lips || !scene.crack_tip.creep_integral,
                     "Creep integral",
                     "must be false: [Boundary] Loaded names a lip, and the "
                     "integral does not include loads there");
    crack_tip.demand(!is_displaced || !scene.crack_tip.creep_integral,
                     "Creep integral",
                     "must be false " + reason);
  }
} // namespace Crevasse
