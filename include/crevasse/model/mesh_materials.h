// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_model_mesh_materials_h
#define crevasse_model_mesh_materials_h

#include <crevasse/discretisation/space.h>
#include <crevasse/parameters/scene.h>

namespace Crevasse
{
  /** Material ids with which formulas of the material compare. */
  std::set<unsigned int>
  compared_materials(const Scene &scene);

  /** Checks formulas of the material. @throw SceneError if one compares with a
   * material id that no cell has. */
  template <int dim>
  void
  require_materials(const Scene &scene, const Mesh<dim> &mesh);

  /** Lists material ids with their names and cells: "1 (blade): 24 cells, 2: 8
   * cells". Collective. */
  template <int dim>
  std::string
  describe_materials(const Scene &scene, const Mesh<dim> &mesh);
} // namespace Crevasse

#endif
