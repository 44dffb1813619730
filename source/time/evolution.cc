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

#include <crevasse/time/evolution.h>

namespace Crevasse
{
  template <int dim>
  Evolution<dim>::Evolution(const StrainOperator<dim>  &strain_operator,
                            const QuadratureField<dim> &points,
                            const MaxwellLaw<dim>      &law,
                            const ExternalLoads<dim>   &loads,
                            ContactSolver              &contact_solver)
    : strain_operator(strain_operator)
    , K(law.stiffness())
    , H(law.fluidity())
    , loads(loads)
    , contact_solver(contact_solver)
  {
    strain_operator.initialize(last.displacement);
    strain_operator.initialize(loading);
    points.initialize(last.stress);
  }



  template <int dim>
  void
  Evolution<dim>::rate(const double t, const Vector &r, Vector &rate)
  {
    using Field = QuadratureField<dim>;

    loads.evaluate(t, loading);
    strain_operator.add_transpose(loading, [&](const std::size_t point) {
      return K * Field::get(r, point);
    });
    contact_solver.solve(loading, last.displacement, last.contact_forces);
    strain_operator.for_each_strain(last.displacement,
                                    [&](const std::size_t       point,
                                        const VoigtVector<dim> &strain) {
                                      const VoigtVector<dim> stress =
                                        K * (strain - Field::get(r, point));
                                      Field::set(last.stress, point, stress);
                                      Field::set(rate, point, H * stress);
                                    });
    ++rate_evaluations;
  }



  template <int dim>
  void
  Evolution<dim>::elastic_state(const double t)
  {
    loads.evaluate(t, loading);
    contact_solver.solve(loading, last.displacement, last.contact_forces);
    strain_operator.for_each_strain(
      last.displacement,
      [&](const std::size_t point, const VoigtVector<dim> &strain) {
        QuadratureField<dim>::set(last.stress, point, K * strain);
      });
  }



  template <int dim>
  const State &
  Evolution<dim>::state() const
  {
    return last;
  }



  template <int dim>
  const Vector &
  Evolution<dim>::right_hand_side() const
  {
    return loading;
  }



  template <int dim>
  std::size_t
  Evolution<dim>::n_rate_evaluations() const
  {
    return rate_evaluations;
  }



  template class Evolution<2>;
  template class Evolution<3>;
} // namespace Crevasse
