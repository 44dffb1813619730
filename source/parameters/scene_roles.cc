// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/parameters/built_in_boundary.h>
#include <crevasse/parameters/checker.h>
#include <crevasse/parameters/scene.h>

namespace Crevasse
{
  void
  check_roles(const Scene &scene, Problems &problems)
  {
    for (const BoundaryRole &role : boundary_role_table)
      if (!(scene.boundary.*role.list).is_valid())
        return;
    const BoundaryRoles roles =
      resolve_roles(scene.boundary, built_in_roles(scene.geometry));
    scene.loads.check_boundaries(roles, problems);
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
