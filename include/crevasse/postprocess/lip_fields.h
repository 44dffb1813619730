// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_lip_fields_h
#define crevasse_postprocess_lip_fields_h

#include <crevasse/discretisation/contact_boundary.h>
#include <crevasse/discretisation/stress_recovery.h>

namespace Crevasse
{
  /** Nodal contact pressure: g / weight, that of a neighbour at held nodes
   * (see ContactBoundary), zero off the lip. */
  template <int dim>
  Vector
  contact_pressure(const Space<dim>           &space,
                   const StressRecovery<dim>  &recovery,
                   const ContactBoundary<dim> &lip,
                   const std::vector<double>  &contact_forces);

  /** Nodal opening of the lips, u_N − gap, the smaller one where two lips meet;
   * zero off the lips. Collective.
   * @param displacement Space::nodal_values() */
  template <int dim>
  Vector
  lip_opening(const Space<dim>           &space,
              const StressRecovery<dim>  &recovery,
              const ContactBoundary<dim> &lip,
              const Vector               &displacement);
} // namespace Crevasse

#endif
