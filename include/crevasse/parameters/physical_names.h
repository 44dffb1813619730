// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_physical_names_h
#define crevasse_parameters_physical_names_h

#include <crevasse/base/problems.h>
#include <crevasse/parameters/catalogue.h>
#include <crevasse/parameters/scene.h>

namespace Crevasse
{
  // A scene with a Gmsh file may use names of physical groups instead of
  // numbers. An unknown name is reported with the known names.

  /** Replaces the names of boundaries in a scene by their ids. */
  void
  replace_boundary_names(Scene &scene, Problems &problems);

  /** Names of the material ids that have a name in the Gmsh file. */
  std::map<unsigned int, std::string>
  material_names(const Scene &scene);

  /** Names of boundary ids: those of the Gmsh file or of the built-in shape. */
  std::map<unsigned int, std::string>
  boundary_names(const Scene &scene);

  /** Replaces quoted names of materials in formulas, as in material == "blade",
   * by their ids.
   * @return those parameters of section Material that quote names, by name,
   * with the replaced formulas. */
  std::map<std::string, std::string>
  named_materials(const Scene                    &scene,
                  const Catalogue                &catalogue,
                  const dealii::ParameterHandler &prm,
                  Problems                       &problems);
} // namespace Crevasse

#endif
