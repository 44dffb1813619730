// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_physical_names_h
#define crevasse_parameters_physical_names_h

#include <crevasse/base/problems.h>
#include <crevasse/parameters/catalogue.h>
#include <crevasse/parameters/scene.h>

namespace Crevasse
{
  // A scene with a Gmsh file may name its physical groups instead of giving
  // their numbers. A name that the file has not is reported, with those that
  // it has.

  /** Replaces the names of boundaries by their ids. */
  void
  replace_boundary_names(Scene &scene, Problems &problems);

  /** The names of material ids that have one. */
  std::map<unsigned int, std::string>
  material_names(const Scene &scene);

  /** Formulas quote the names of materials, as in material == "blade".
   * @return by name, the parameters of section Material that do, with the
   * material ids in place of the names. */
  std::map<std::string, std::string>
  named_materials(const Scene                    &scene,
                  const Catalogue                &catalogue,
                  const dealii::ParameterHandler &prm,
                  Problems                       &problems);
} // namespace Crevasse

#endif
