// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_model_secular_h
#define crevasse_model_secular_h

#include <crevasse/discretisation/material_field.h>


namespace Crevasse
{
  template <int dim>
  struct Body;
  struct SecularFlow;

  /** The viscosities of the branches of a material at the quadrature points,
   * without the factor η₀. */
  template <int dim>
  struct Viscosity
  {
    using Matrices = PointValues<VoigtMatrix<dim>>;

    std::vector<Matrices> branches; ///< ηᵢ = Hᵢ⁻¹, in the plane in plane stress
    Matrices              sum; ///< Σ ηᵢ
  };

  /** @throw NumericalError if a fluidity is singular: then a part of the
   * strain does not flow at all. */
  template <int dim>
  Viscosity<dim>
  viscosity_of(const MaterialState<dim> &material, const std::size_t n_points);

  /** Whether all fluidities have an inverse, on this rank. */
  template <int dim>
  bool
  has_viscosity(const MaterialState<dim> &material);

  /** Sets αᵢ = Hᵢ ηᵢ Dβ of a flow with known β: that is Dβ, and the creep in
   * thickness with it. */
  template <int dim>
  void
  set_strain_rates(const Body<dim>          &body,
                   const MaterialState<dim> &material,
                   const Viscosity<dim>     &viscosity,
                   SecularFlow              &flow);
} // namespace Crevasse

#endif
