// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_stiffness_h
#define crevasse_discretisation_stiffness_h

#include <crevasse/discretisation/point_values.h>
#include <crevasse/discretisation/quadrature_field.h>
#include <crevasse/discretisation/shape_strains.h>
#include <crevasse/discretisation/space.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <vector>

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
                     SparseMatrix                        &matrix)
  {
    std::vector<dealii::types::global_dof_index> indices;
    if (matrix.m() == 0)
      {
        const dealii::IndexSet &owned = space.locally_owned_unknowns();
        dealii::TrilinosWrappers::SparsityPattern sparsity(
          owned,
          owned,
          space.locally_relevant_unknowns(),
          space.communicator());
        for (const auto &cell : owned_cells(space.dof_handler()))
          {
            space.get_unknowns(cell, indices);
            space.constraints().add_entries_local_to_global(indices,
                                                            sparsity,
                                                            false);
          }
        sparsity.compress();
        matrix.reinit(sparsity);
      }
    else
      matrix = 0.;

    ShapeStrains<dim>             shapes(space);
    std::vector<VoigtVector<dim>> strains;
    dealii::FullMatrix<double>    cell_matrix;
    for (const auto &cell : owned_cells(space.dof_handler()))
      {
        const dealii::FEValues<dim> &values = shapes.reinit(cell);
        space.get_unknowns(cell, indices);
        const unsigned int n = indices.size();
        cell_matrix.reinit(n, n);
        const std::size_t first = points.first_point(cell);
        for (const unsigned int q : values.quadrature_point_indices())
          {
            shapes.at_point(q, strains);
            for (unsigned int i = 0; i < n; ++i)
              {
                const VoigtVector<dim> stress =
                  stiffness[first + q] * strains[i] * values.JxW(q);
                for (unsigned int j = 0; j < n; ++j)
                  cell_matrix(i, j) += stress * strains[j];
              }
          }
        space.constraints().distribute_local_to_global(cell_matrix,
                                                       indices,
                                                       matrix);
      }
    matrix.compress(dealii::VectorOperation::add);
  }
} // namespace Crevasse

#endif
