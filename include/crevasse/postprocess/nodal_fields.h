// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_nodal_fields_h
#define crevasse_postprocess_nodal_fields_h

#include <crevasse/discretisation/contact_boundary.h>
#include <crevasse/discretisation/space.h>
#include <crevasse/discretisation/stress_recovery.h>

#include <array>
#include <vector>

namespace Crevasse
{
  /** What is derived from the recovered stress, node by node. */
  template <int dim>
  struct StressInvariants
  {
    /** In the plane (space) of the mesh, the largest first. */
    std::array<Vector, dim> principal_stress;
    /** Unit vectors, in the displacement space. */
    std::array<Vector, dim> principal_direction;
    /** J₂ = ½ s′:s′ with the deviator s′ of the three-dimensional stress. */
    Vector second_deviator_invariant;
  };

  template <int dim>
  StressInvariants<dim>
  stress_invariants(const Space<dim>          &space,
                    const StressRecovery<dim> &recovery,
                    const std::vector<Vector> &nodal_stress);

  /** Nodal contact pressure: g / weight, that of a neighbour at held nodes
   * (see ContactBoundary), zero off the lip. */
  template <int dim>
  Vector
  contact_pressure(const Space<dim>           &space,
                   const StressRecovery<dim>  &recovery,
                   const ContactBoundary<dim> &lip,
                   const std::vector<double>  &contact_forces);
} // namespace Crevasse

#endif
