// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_stiffness_h
#define crevasse_discretisation_stiffness_h

#include <crevasse/discretisation/cell_values.h>
#include <crevasse/discretisation/point_values.h>
#include <crevasse/discretisation/quadrature_field.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

namespace Crevasse
{
  using SparseMatrix = dealii::TrilinosWrappers::SparseMatrix;

  /** Strains of all shape functions of a cell, nodal and singular, at the
   * points of its rule, in the order of Space::get_unknowns(). */
  template <int dim>
  class ShapeStrains
  {
  public:
    /** Prepares shape functions. @param space Must outlive this object. */
    explicit ShapeStrains(const Space<dim> &space)
      : space(space)
      , cell_values(space,
                    dealii::update_gradients | dealii::update_JxW_values |
                      dealii::update_quadrature_points |
                      (space.roles.has_axis ? dealii::update_values
                                            : dealii::update_default))
    {
    }

    const dealii::FEValues<dim> &
    reinit(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell)
    {
      values = &cell_values.reinit(cell);
      if (space.volumetric_strain == VolumetricStrain::mean)
        find_mean_dilatations();
      if constexpr (dim == 2)
        if (const SingularShapes *shapes = space.singular_shapes())
          shapes->gradients(*values, singular_gradients);
      return *values;
    }

    void
    at_point(const unsigned int q, std::vector<VoigtVector<dim>> &strains) const
    {
      const dealii::FESystem<dim> &fe = space.finite_element;
      strains.assign(fe.n_dofs_per_cell(), VoigtVector<dim>());
      for (unsigned int i = 0; i < strains.size(); ++i)
        {
          const unsigned int c        = fe.system_to_component_index(i).first;
          const auto         gradient = values->shape_grad_component(i, q, c);
          for (unsigned int d = 0; d < dim; ++d)
            strains[i][voigt_index<dim>(c, d)] = gradient[d];
          const double hoop = hoop_strain(i, q);
          strains[i][2] += hoop;
          if (!mean_dilatations.empty())
            for (unsigned int d = 0; d < 3; ++d)
              strains[i][d] += (mean_dilatations[i] - gradient[c] - hoop) / 3.;
        }
      for (const auto &gradients : singular_gradients)
        strains.push_back(voigt_strain<dim>(gradients[q]));
    }

  private:
    /** Hoop strain u₁/x₁ of a shape function; 0 without an axis. */
    double
    hoop_strain(const unsigned int i, const unsigned int q) const
    {
      return space.roles.has_axis ? values->shape_value_component(i, q, 0) /
                                      values->quadrature_point(q)[0]
                                  : 0.;
    }

    /** Computes the means over the cell of shape functions' dilatations. */
    void
    find_mean_dilatations()
    {
      const dealii::FESystem<dim> &fe     = space.finite_element;
      double                       volume = 0.;
      mean_dilatations.assign(fe.n_dofs_per_cell(), 0.);
      for (const unsigned int q : values->quadrature_point_indices())
        {
          volume += values->JxW(q);
          for (unsigned int i = 0; i < mean_dilatations.size(); ++i)
            {
              const unsigned int c = fe.system_to_component_index(i).first;
              mean_dilatations[i] +=
                (values->shape_grad_component(i, q, c)[c] + hoop_strain(i, q)) *
                values->JxW(q);
            }
        }
      for (double &mean : mean_dilatations)
        mean /= volume;
    }

    const Space<dim>                                &space;
    CellValues<dim>                                  cell_values;
    const dealii::FEValues<dim>                     *values = nullptr;
    std::vector<double>                              mean_dilatations;
    std::vector<std::vector<dealii::Tensor<2, dim>>> singular_gradients;
  };



  /**
   * Assembles A = ∫ DᵀKD. Constrained dofs are condensed: their rows and
   * columns hold a positive diagonal entry and nothing else.
   *
   * @param stiffness K (or η, for the secular problem), in units of stress, at
   * the quadrature points.
   * @param[in,out] matrix Empty, or a matrix of the same space, which keeps its
   * sparsity pattern.
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
        const dealii::IndexSet &owned = space.locally_owned_unknowns;
        dealii::TrilinosWrappers::SparsityPattern sparsity(
          owned, owned, space.locally_relevant_unknowns, space.communicator());
        for (const auto &cell : owned_cells(space.dof_handler))
          {
            space.get_unknowns(cell, indices);
            space.constraints.add_entries_local_to_global(indices,
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
    for (const auto &cell : owned_cells(space.dof_handler))
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
        space.constraints.distribute_local_to_global(cell_matrix,
                                                     indices,
                                                     matrix);
      }
    matrix.compress(dealii::VectorOperation::add);
  }
} // namespace Crevasse

#endif
