// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_cell_polynomials_h
#define crevasse_discretisation_cell_polynomials_h

#include <crevasse/discretisation/quadrature_field.h>
#include <crevasse/discretisation/space.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/lac/full_matrix.h>

namespace Crevasse
{
  /** The same cell of another mesh with the same cells, with its dofs. */
  template <int dim>
  typename dealii::DoFHandler<dim>::cell_iterator
  same_cell(const dealii::CellId &name, const dealii::DoFHandler<dim> &dofs)
  {
    const auto &mesh = dofs.get_triangulation();
    const auto  cell = mesh.create_cell_iterator(name);
    return {&mesh, cell->level(), cell->index(), &dofs};
  }

  /**
   * Fields at quadrature points as one polynomial a cell, of the degree of the
   * displacement in each direction: the one through the values where Gauss's
   * rule has as many points as it has coefficients, else the nearest one, with
   * the weights of the rule. What is at the points can be differentiated then,
   * seen from the faces, and given to other cells.
   */
  template <int dim>
  class CellPolynomials
  {
  public:
    static constexpr unsigned int n_components = n_stress_components<dim>;

    /** @param mesh that must outlive this object, but may be refined. */
    CellPolynomials(const Mesh<dim> &mesh, const unsigned int degree);

    /** Numbers the coefficients, again after a change of the mesh. */
    void
    distribute();

    /** Of the coefficients of one vector at a point; their components are those
     * of a QuadratureField. */
    const dealii::DoFHandler<dim> &
    dof_handler() const
    {
      return dofs;
    }

    /** A vector of coefficients, with those of the ghost cells. */
    Vector
    coefficients() const;

    /** Fits the values of one branch, and sets ghost values. Collective.
     *
     * @param n_branches, branch see QuadratureField::initialize(). */
    void
    fit(const Space<dim>           &space,
        const QuadratureField<dim> &points,
        const Vector               &field,
        Vector                     &coefficients,
        const unsigned int          n_branches = 1,
        const unsigned int          branch     = 0) const;

    /** The values of the polynomials at the points, for one branch. The space
     * may be on another mesh with the same cells on each rank. */
    void
    evaluate(const Space<dim>           &space,
             const QuadratureField<dim> &points,
             const Vector               &coefficients,
             Vector                     &field,
             const unsigned int          n_branches = 1,
             const unsigned int          branch     = 0) const;

  private:
    /** From the values at the points of a cell to its coefficients. */
    dealii::FullMatrix<double>
    fitting_matrix(const dealii::Quadrature<dim> &rule) const;

    const dealii::FESystem<dim> fe;
    dealii::DoFHandler<dim>     dofs;
  };
} // namespace Crevasse

#endif
