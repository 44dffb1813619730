// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/cell_polynomials.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_dgq.h>
#include <deal.II/fe/fe_tools.h>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  CellPolynomials<dim>::CellPolynomials(const Mesh<dim>   &mesh,
                                        const unsigned int degree)
    : fe(FE_DGQ<dim>(degree), n_components)
    , dofs(mesh)
  {
    distribute();
  }



  template <int dim>
  void
  CellPolynomials<dim>::distribute()
  {
    dofs.distribute_dofs(fe);
  }



  template <int dim>
  Vector
  CellPolynomials<dim>::coefficients() const
  {
    IndexSet relevant;
    DoFTools::extract_locally_relevant_dofs(dofs, relevant);
    return Vector(dofs.locally_owned_dofs(), relevant, dofs.get_communicator());
  }



  template <int dim>
  FullMatrix<double>
  CellPolynomials<dim>::fitting_matrix(const Quadrature<dim> &rule) const
  {
    const FiniteElement<dim> &scalar = fe.base_element(0);
    FullMatrix<double>        matrix(scalar.n_dofs_per_cell(), rule.size());
    FETools::compute_projection_from_quadrature_points_matrix(scalar,
                                                              rule,
                                                              rule,
                                                              matrix);
    return matrix;
  }



  template <int dim>
  void
  CellPolynomials<dim>::fit(const Space<dim>           &space,
                            const QuadratureField<dim> &points,
                            const Vector               &field,
                            Vector                     &coefficients,
                            const unsigned int          n_branches,
                            const unsigned int          branch) const
  {
    std::vector<FullMatrix<double>> matrices;
    for (const Quadrature<dim> &rule : space.quadratures())
      matrices.push_back(fitting_matrix(rule));
    std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
    coefficients.zero_out_ghost_values();
    coefficients = 0.;
    for (const auto &cell : dofs.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          cell->get_dof_indices(indices);
          const FullMatrix<double> &matrix = matrices[space.rule(cell)];
          const std::size_t         first  = n_branches * points.offset(cell);
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



  template <int dim>
  void
  CellPolynomials<dim>::evaluate(const Space<dim>           &space,
                                 const QuadratureField<dim> &points,
                                 const Vector               &coefficients,
                                 Vector                     &field,
                                 const unsigned int          n_branches,
                                 const unsigned int          branch) const
  {
    const FiniteElement<dim>            &scalar = fe.base_element(0);
    std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
    for (const auto &cell : space.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          same_cell(cell->id(), dofs)->get_dof_indices(indices);
          const Quadrature<dim> &rule  = space.quadrature(cell);
          const std::size_t      first = n_branches * points.offset(cell);
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



  template class CellPolynomials<2>;
  template class CellPolynomials<3>;
} // namespace Crevasse
