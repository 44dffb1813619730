// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_operator_check_h
#define crevasse_linear_operator_check_h

#include <crevasse/linear/stiffness_operator.h>

namespace Crevasse
{
  /**
   * Checks a StiffnessOperator A. Compares A v with ∫ DᵀK D v by the
   * StrainOperator of stresses and loads, for one non-smooth v; and D and Dᵀ,
   * whose geometry and constraints A shares, with those of the assembly in up
   * to 100 cells of each rank. Contact and its certificate both use A, so that
   * an error of A would not be noticed. Costs about three products. Collective.
   *
   * @param stiffness K from which A was made.
   * @throw NumericalError if A v differs by more than 1e-10 in the l₂ norm, or
   * the work of stresses in those cells by 1e-9.
   */
  template <int dim>
  void
  require_same_product(const StiffnessOperator<dim>        &A,
                       const Space<dim>                    &space,
                       const QuadratureField<dim>          &points,
                       const PointValues<VoigtMatrix<dim>> &stiffness);
} // namespace Crevasse

#endif
