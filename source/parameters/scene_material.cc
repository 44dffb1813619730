// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/parameters/checker.h>
#include <crevasse/parameters/scene.h>

namespace Crevasse
{
  void
  check_material(const Scene &scene, Problems &problems)
  {
    const MaterialParameters &material = scene.material;
    const Checker             checker(MaterialParameters::section, problems);
    const bool plane_stress = material.plane_state == PlaneState::plane_stress;
    const auto check =
      [&](const char *name, const auto &value, const auto &...more) {
        if (value.is_valid())
          checker.demand_readable(name, [&]() {
            require_size(value, scene.dimension, more...);
          });
      };
    if (!material.stiffness_matrix.text().empty())
      check("Stiffness matrix", material.stiffness_matrix, plane_stress);
    if (material.viscosity == ViscosityType::matrix &&
        !material.viscosity_matrix.text().empty())
      check("Viscosity matrix", material.viscosity_matrix, plane_stress);
    checker.demand(!material.relaxes_in_shear_only() || scene.dimension == 3 ||
                     !plane_stress,
                   "Chain in shear only",
                   "is not possible in plane stress, where the bodies of a "
                   "chain would press each other through the thickness; set "
                   "Plane state = plane strain, or use Dimension = 3");
    for (const auto &strain : material.free_strains())
      check(strain.parameter, strain.components);
  }
} // namespace Crevasse
