// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#ifndef crevasse_time_evolution_h
#define crevasse_time_evolution_h

#include <crevasse/contact/contact_solver.h>
#include <crevasse/discretisation/external_loads.h>
#include <crevasse/discretisation/quadrature_field.h>
#include <crevasse/discretisation/strain_operator.h>
#include <crevasse/material/maxwell_law.h>

#include <vector>

namespace Crevasse
{
  /** The body at one instant. */
  struct State
  {
    Vector              displacement;   ///< q; zero in constrained entries
    Vector              stress;         ///< s at quadrature points
    std::vector<double> contact_forces; ///< g for each local lip node
  };

  /**
   * The right-hand side of the ODE (model, §2): for given viscous strain r,
   *
   *     A q − b(r,t) = Lᵀ g,   0 ≤ g ⟂ L q − gap ≥ 0,   b = ∫ DᵀK r + loads
   *     s = K (D q − r),       ṙ = H s.
   *
   * Each evaluation solves one variational inequality, started from the last
   * solution.
   */
  template <int dim>
  class Evolution
  {
  public:
    /** All arguments must outlive this object. */
    Evolution(const StrainOperator<dim>  &strain_operator,
              const QuadratureField<dim> &points,
              const MaxwellLaw<dim>      &law,
              const ExternalLoads<dim>   &loads,
              ContactSolver              &contact_solver);

    /** ṙ for the viscous strain @p r at the instant @p t of the period. */
    void
    rate(const double t, const Vector &r, Vector &rate);

    /** The state of a body without viscous strain at the instant @p t. */
    void
    elastic_state(const double t);

    /** What the last evaluation has solved. */
    const State &
    state() const;

    /** b of the last evaluation. */
    const Vector &
    right_hand_side() const;

    std::size_t
    n_rate_evaluations() const;

  private:
    const StrainOperator<dim> &strain_operator;
    const VoigtMatrix<dim>     K;
    const VoigtMatrix<dim>     H;
    const ExternalLoads<dim>  &loads;
    ContactSolver             &contact_solver;

    State       last;
    Vector      loading;
    std::size_t rate_evaluations = 0;
  };
} // namespace Crevasse

#endif
