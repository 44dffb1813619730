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

#include <crevasse/discretisation/stiffness.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** The strain of the shape function with the one nonzero component
     * @p component. */
    template <int dim>
    VoigtVector<dim>
    shape_strain(const Tensor<1, dim> &gradient, const unsigned int component)
    {
      VoigtVector<dim> strain;
      for (unsigned int d = 0; d < dim; ++d)
        strain[voigt_index<dim>(component, d)] = gradient[d];
      return strain;
    }



    /** The means over a cell of the dilatations of its shape functions. */
    template <int dim>
    std::vector<double>
    mean_dilatations(const FEValues<dim> &values)
    {
      const FiniteElement<dim> &fe = values.get_fe();
      std::vector<double>       means(fe.n_dofs_per_cell(), 0.);
      double                    volume = 0.;
      for (const unsigned int q : values.quadrature_point_indices())
        {
          volume += values.JxW(q);
          for (unsigned int i = 0; i < means.size(); ++i)
            {
              const unsigned int c = fe.system_to_component_index(i).first;
              means[i] +=
                values.shape_grad_component(i, q, c)[c] * values.JxW(q);
            }
        }
      for (double &mean : means)
        mean /= volume;
      return means;
    }



    /** Adds a dilatation in equal parts to all three directions. */
    template <int dim>
    void
    add_dilatation(VoigtVector<dim> &strain, const double dilatation)
    {
      for (unsigned int i = 0; i < 3; ++i)
        strain[i] += dilatation / 3.;
    }



    template <int dim>
    void
    initialize_matrix(const Space<dim> &space, SparseMatrix &matrix)
    {
      const DoFHandler<dim> &dofs = space.dof_handler();
      IndexSet               relevant;
      DoFTools::extract_locally_relevant_dofs(dofs, relevant);
      TrilinosWrappers::SparsityPattern sparsity(dofs.locally_owned_dofs(),
                                                 dofs.locally_owned_dofs(),
                                                 relevant,
                                                 space.communicator());
      DoFTools::make_sparsity_pattern(dofs,
                                      sparsity,
                                      space.constraints(),
                                      false,
                                      Utilities::MPI::this_mpi_process(
                                        space.communicator()));
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

    const FESystem<dim> &fe = space.finite_element();
    const unsigned int   n  = fe.n_dofs_per_cell();
    FEValues<dim>        values(space.mapping(),
                         fe,
                         space.quadrature(),
                         update_gradients | update_JxW_values);

    FullMatrix<double>                   cell_matrix(n, n);
    std::vector<types::global_dof_index> indices(n);
    std::vector<VoigtVector<dim>>        strains(n);
    std::vector<double>                  means;
    const bool                           mean_volume =
      space.volumetric_strain() == VolumetricStrain::mean;
    for (const auto &cell : space.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          values.reinit(cell);
          cell_matrix = 0.;
          const std::size_t first =
            points.offset(cell) / n_stress_components<dim>;
          if (mean_volume)
            means = mean_dilatations(values);
          for (const unsigned int q : values.quadrature_point_indices())
            {
              for (unsigned int i = 0; i < n; ++i)
                {
                  const unsigned int c = fe.system_to_component_index(i).first;
                  const Tensor<1, dim> gradient =
                    values.shape_grad_component(i, q, c);
                  strains[i] = shape_strain<dim>(gradient, c);
                  if (mean_volume)
                    add_dilatation<dim>(strains[i], means[i] - gradient[c]);
                }
              for (unsigned int i = 0; i < n; ++i)
                {
                  const VoigtVector<dim> stress =
                    stiffness[first + q] * strains[i] * values.JxW(q);
                  for (unsigned int j = 0; j < n; ++j)
                    cell_matrix(i, j) += stress * strains[j];
                }
            }
          cell->get_dof_indices(indices);
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
