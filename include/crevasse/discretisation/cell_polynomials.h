// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_cell_polynomials_h
#define crevasse_discretisation_cell_polynomials_h

#include <crevasse/discretisation/quadrature_field.h>

#include <deal.II/fe/fe_dgq.h>
#include <deal.II/fe/fe_tools.h>
#include <deal.II/lac/full_matrix.h>

namespace Crevasse
{
  /** Matrices from values at points of a cell to coefficients of the nearest
   * polynomial, for each rule of a space.
   * @param fe Element with one component. */
  template <int dim>
  std::vector<dealii::FullMatrix<double>>
  fitting_matrices(const dealii::FiniteElement<dim> &fe,
                   const Space<dim>                 &space)
  {
    std::vector<dealii::FullMatrix<double>> matrices;
    for (const dealii::Quadrature<dim> &rule : space.quadratures)
      {
        matrices.emplace_back(fe.n_dofs_per_cell(), rule.size());
        dealii::FETools::compute_projection_from_quadrature_points_matrix(
          fe, rule, rule, matrices.back());
      }
    return matrices;
  }

  /** Cell of a DoFHandler that has this id in an equal mesh. */
  template <int dim>
  typename dealii::DoFHandler<dim>::cell_iterator
  same_cell(const dealii::CellId          &name,
            const dealii::DoFHandler<dim> &dof_handler)
  {
    const auto &mesh = dof_handler.get_triangulation();
    const auto  cell = mesh.create_cell_iterator(name);
    return {&mesh, cell->level(), cell->index(), &dof_handler};
  }

  /**
   * Fields at quadrature points as a polynomial in each cell, of the degree of
   * the displacement in each direction: it interpolates the values where
   * Gauss's rule has as many points as the polynomial has coefficients, else it
   * is the nearest one with the weights of the rule. Polynomials can be
   * differentiated, evaluated on faces, and transferred to other cells.
   */
  template <int dim>
  class CellPolynomials
  {
  public:
    static constexpr unsigned int n_components = n_stress_components<dim>;

    /** @param mesh Must outlive this object, but may be refined. */
    CellPolynomials(const Mesh<dim> &mesh, const unsigned int degree)
      : dof_handler(mesh)
      , fe(dealii::FE_DGQ<dim>(degree), n_components)
    {
      distribute();
    }

    /** Numbers the coefficients; also call this after a change of the mesh. */
    void
    distribute()
    {
      dof_handler.distribute_dofs(fe);
    }

    /** Numbering of the coefficients of one Voigt vector at a point, with the
     * components of a QuadratureField. */
    dealii::DoFHandler<dim> dof_handler;

    /** Vector of zero coefficients, with those of the ghost cells. */
    Vector
    coefficients() const
    {
      return make_vector(dof_handler);
    }

    /** Fits the values of one branch, and sets ghost values. Collective.
     *
     * @param n_branches, branch See QuadratureField::initialize(). */
    void
    fit(const Space<dim>           &space,
        const QuadratureField<dim> &points,
        const Vector               &field,
        Vector                     &coefficients,
        const unsigned int          n_branches = 1,
        const unsigned int          branch     = 0) const
    {
      const auto matrices = fitting_matrices(fe.base_element(0), space);
      std::vector<dealii::types::global_dof_index> indices(
        fe.n_dofs_per_cell());
      coefficients.zero_out_ghost_values();
      coefficients = 0.;
      for (const auto &cell : owned_cells(dof_handler))
        {
          cell->get_dof_indices(indices);
          const auto       &matrix = matrices[space.rule(cell)];
          const std::size_t first  = n_branches * points.offset(cell);
          for (unsigned int i = 0; i < matrix.m(); ++i)
            for (unsigned int q = 0; q < matrix.n(); ++q)
              for (unsigned int c = 0; c < n_components; ++c)
                coefficients(indices[fe.component_to_system_index(c, i)]) +=
                  matrix(i, q) *
                  field.local_element(
                    first + (q * n_branches + branch) * n_components + c);
        }
      coefficients.update_ghost_values();
    }

    /** Evaluates the polynomials at the points, for one branch. The space may
     * be on another mesh with the same cells on each rank. */
    void
    evaluate(const Space<dim>           &space,
             const QuadratureField<dim> &points,
             const Vector               &coefficients,
             Vector                     &field,
             const unsigned int          n_branches = 1,
             const unsigned int          branch     = 0) const
    {
      const dealii::FiniteElement<dim>            &scalar = fe.base_element(0);
      std::vector<dealii::types::global_dof_index> indices(
        fe.n_dofs_per_cell());
      for (const auto &cell : owned_cells(space.dof_handler))
        {
          same_cell(cell->id(), dof_handler)->get_dof_indices(indices);
          const dealii::Quadrature<dim> &rule = space.quadrature(cell);
          const std::size_t first = n_branches * points.offset(cell);
          for (unsigned int q = 0; q < rule.size(); ++q)
            for (unsigned int c = 0; c < n_components; ++c)
              {
                double value = 0.;
                for (unsigned int i = 0; i < scalar.n_dofs_per_cell(); ++i)
                  value +=
                    scalar.shape_value(i, rule.point(q)) *
                    coefficients(indices[fe.component_to_system_index(c, i)]);
                field.local_element(
                  first + (q * n_branches + branch) * n_components + c) = value;
              }
        }
    }

  private:
    const dealii::FESystem<dim> fe;
  };
} // namespace Crevasse

#endif
