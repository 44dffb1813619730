// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_cell_polynomials_h
#define crevasse_discretisation_cell_polynomials_h

#include <crevasse/discretisation/quadrature_field.h>
#include <crevasse/discretisation/space.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/lac/full_matrix.h>

#include <vector>

namespace Crevasse
{
  /** From the values at the points of a cell to the coefficients of the nearest
   * polynomial, for each rule of a space.
   * @param fe with one component. */
  template <int dim>
  std::vector<dealii::FullMatrix<double>>
  fitting_matrices(const dealii::FiniteElement<dim> &fe,
                   const Space<dim>                 &space);

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
    distribute()
    {
      dofs.distribute_dofs(fe);
    }

    /** Of the coefficients of one vector at a point; their components are those
     * of a QuadratureField. */
    const dealii::DoFHandler<dim> &
    dof_handler() const
    {
      return dofs;
    }

    /** A vector of coefficients, with those of the ghost cells. */
    Vector
    coefficients() const
    {
      return make_vector(dofs);
    }

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

    /** The values of the polynomials at the points, for one branch. */
    void
    evaluate(const Space<dim>           &space,
             const QuadratureField<dim> &points,
             const Vector               &coefficients,
             Vector                     &field,
             const unsigned int          n_branches = 1,
             const unsigned int          branch     = 0) const;

  private:
    const dealii::FESystem<dim> fe;
    dealii::DoFHandler<dim>     dofs;
  };
} // namespace Crevasse

#endif
