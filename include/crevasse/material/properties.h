// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_material_properties_h
#define crevasse_material_properties_h

#include <crevasse/material/property.h>
#include <crevasse/material/voigt.h>
#include <crevasse/parameters/parameters.h>

namespace Crevasse
{
  // The properties of a material from the formulas of its scene.

  /** K, isotropic or from its matrix. */
  template <int dim>
  Property<VoigtMatrix<dim>>
  stiffness_property(const MaterialParameters &parameters);

  /** H = (τK)⁻¹ / fraction. */
  template <int dim>
  Property<VoigtMatrix<dim>>
  proportional_fluidity(const MaterialParameters &parameters,
                        const Expression         &relaxation_time,
                        const double              fraction);

  /** H of Viscous modulus and Viscous Poisson ratio. */
  template <int dim>
  Property<VoigtMatrix<dim>>
  isotropic_fluidity(const MaterialParameters &parameters);

  /** H = η⁻¹ of Viscosity matrix. */
  template <int dim>
  Property<VoigtMatrix<dim>>
  fluidity_of_matrix(const MaterialParameters &parameters);

  /** A strain, with engineering shears, of a scalar or a tensor. */
  template <int dim>
  Property<VoigtVector<dim>>
  strain_property(const Formulas &components);
} // namespace Crevasse

#endif
