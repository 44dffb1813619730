// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_model_tip_functions_h
#define crevasse_model_tip_functions_h

#include <crevasse/discretisation/space.h>
#include <crevasse/material/maxwell_law.h>
#include <crevasse/parameters/scene.h>
#include <crevasse/temperature/temperature.h>

namespace Crevasse
{


  /** The elastic body around a tip at an instant, without its factor k.
   * @throw SceneError if it is not isotropic, or not the same in all cells
   * that have the tip for a vertex. */
  PlaneElasticity
  elasticity_at(const CrackTip                 &tip,
                const dealii::Triangulation<2> &mesh,
                const MaxwellLaw<2>            &law,
                const Temperature<2>           &temperature,
                const double                    t,
                const std::string              &wanted_by);

  /** The singular functions of [Discretisation]; without fields if there are
   * none. Collective. @throw SceneError as the above. */
  template <int dim>
  SingularFunctions
  tip_functions(const Scene            &scene,
                const Mesh<dim>        &mesh,
                const BoundaryRoles    &roles,
                const MaxwellLaw<dim>  &law,
                const Temperature<dim> &temperature);
} // namespace Crevasse

#endif
