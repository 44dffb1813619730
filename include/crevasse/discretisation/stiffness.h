// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_stiffness_h
#define crevasse_discretisation_stiffness_h

#include <crevasse/discretisation/point_values.h>
#include <crevasse/discretisation/quadrature_field.h>
#include <crevasse/discretisation/space.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

namespace Crevasse
{
  using SparseMatrix = dealii::TrilinosWrappers::SparseMatrix;

  /**
   * Assembles A = ∫ DᵀKD. Constrained dofs are condensed: their rows and
   * columns hold a positive diagonal entry and nothing else.
   *
   * @param stiffness K (or η, for the secular problem), in units of stress, at
   * the quadrature points.
   * @param[in,out] matrix Empty, or one of the same space, whose sparsity
   * pattern then is kept.
   */
  template <int dim>
  void
  assemble_stiffness(const Space<dim>                    &space,
                     const QuadratureField<dim>          &points,
                     const PointValues<VoigtMatrix<dim>> &stiffness,
                     SparseMatrix                        &matrix);
} // namespace Crevasse

#endif
