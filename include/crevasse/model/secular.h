// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_model_secular_h
#define crevasse_model_secular_h

#include <crevasse/contact/contact_solver.h>
#include <crevasse/discretisation/material_field.h>
#include <crevasse/discretisation/strain_operator.h>
#include <crevasse/time/secular_flow.h>

#include <vector>

namespace Crevasse
{
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

  /**
   * The secular problem P3 (model, §2): β ∈ C₀ with
   *
   *     ∫ ε(v−β) : η ε(β) ≥ f̄ · (v−β)     for all v ∈ C₀,
   *
   * where f̄ is the mean of the loads divided by η₀, and C₀ the cone of a lip
   * without gap.
   *
   * @param contact_solver of ∫ Dᵀ η D / @p time with bounds of gap 0. With
   * η = τK and τ for the time that is the one of the stiffness.
   */
  template <int dim>
  SecularFlow
  secular_flow_of(const StrainOperator<dim>  &strain_operator,
                  const QuadratureField<dim> &points,
                  const MaterialState<dim>   &material,
                  const Viscosity<dim>       &viscosity,
                  const Vector               &mean_load,
                  const double                time,
                  ContactSolver              &contact_solver);
} // namespace Crevasse

#endif
