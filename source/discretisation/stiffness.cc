// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/shape_strains.h>
#include <crevasse/discretisation/stiffness.h>

#include <deal.II/lac/trilinos_sparsity_pattern.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    void
    initialize_matrix(const Space<dim> &space, SparseMatrix &matrix)
    {
      const IndexSet                   &owned = space.locally_owned_unknowns();
      TrilinosWrappers::SparsityPattern sparsity(
        owned, owned, space.locally_relevant_unknowns(), space.communicator());
      std::vector<types::global_dof_index> indices;
      for (const auto &cell : space.dof_handler().active_cell_iterators())
        if (cell->is_locally_owned())
          {
            space.get_unknowns(cell, indices);
            space.constraints().add_entries_local_to_global(indices,
                                                            sparsity,
                                                            false);
          }
      sparsity.compress();
      matrix.reinit(sparsity);
    }
  } // namespace



  template <int dim>
  void
  assemble_stiffness(const Space<dim>                    &space,
                     const QuadratureField<dim>          &points,
                     const PointValues<VoigtMatrix<dim>> &stiffness,
                     SparseMatrix                        &matrix)
  {
    if (matrix.m() == 0)
      initialize_matrix(space, matrix);
    else
      matrix = 0.;

    ShapeStrains<dim>                    shapes(space);
    std::vector<types::global_dof_index> indices;
    std::vector<VoigtVector<dim>>        strains;
    FullMatrix<double>                   cell_matrix;
    for (const auto &cell : space.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const FEValues<dim> &values = shapes.reinit(cell);
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
    matrix.compress(VectorOperation::add);
  }



  template void
  assemble_stiffness<2>(const Space<2> &,
                        const QuadratureField<2> &,
                        const PointValues<VoigtMatrix<2>> &,
                        SparseMatrix &);
  template void
  assemble_stiffness<3>(const Space<3> &,
                        const QuadratureField<3> &,
                        const PointValues<VoigtMatrix<3>> &,
                        SparseMatrix &);
} // namespace Crevasse
