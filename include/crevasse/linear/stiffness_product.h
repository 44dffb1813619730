// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_stiffness_product_h
#define crevasse_linear_stiffness_product_h

#include <crevasse/discretisation/cell_loops.h>
#include <crevasse/discretisation/point_values.h>
#include <crevasse/discretisation/quadrature_field.h>

#include <deal.II/base/subscriptor.h>

#include <functional>

namespace Crevasse
{
  /**
   * Products with A = ∫ DᵀKD in single or double precision: what
   * assemble_stiffness() writes into a matrix, without the matrix. Rows and
   * columns of constrained unknowns are those of the identity.
   */
  template <int dim, typename Real>
  class StiffnessProduct : public dealii::Subscriptor
  {
  public:
    using Vector = dealii::LinearAlgebra::distributed::Vector<Real>;

    /** Work on a range of vector entries. */
    using RangeFunction =
      std::function<void(const unsigned int, const unsigned int)>;

    /** Without singular functions.
     *
     * @param space must outlive this object.
     * @param stiffness K at the quadrature points; a copy is made.
     * @param unit of K. The product is that of A divided by it; in single
     * precision lengths have the unit of CellLoops::length_unit() besides. */
    StiffnessProduct(const Space<dim>                    &space,
                     const QuadratureField<dim>          &points,
                     const PointValues<VoigtMatrix<dim>> &stiffness,
                     const double                         unit = 1.);

    void
    initialize(Vector &vector) const
    {
      loops->initialize(vector);
    }

    /** Both with the layout of initialize(). Collective. */
    void
    vmult(Vector &result, const Vector &v) const;

    /** The same, with work before it and after it. */
    void
    vmult(Vector              &result,
          const Vector        &v,
          const RangeFunction &before,
          const RangeFunction &after) const;

    /** Makes these unconstrained rows and columns those of the identity, until
     * others are named, for vectors that are zero there. (The diagonal stays
     * what it is.)
     *
     * @param rows local indices of locally owned unknowns. */
    void
    hold(const std::vector<unsigned int> &rows)
    {
      held_rows = rows;
    }

    /** 1 where constrained. The masters of hanging nodes have the squares of
     * their weights times the diagonal of these only. */
    const Vector &
    diagonal() const
    {
      return operator_diagonal;
    }

    dealii::types::global_dof_index
    m() const
    {
      return operator_diagonal.size();
    }

    /** A diagonal entry of this rank, for smoothers. */
    Real
    el(const dealii::types::global_dof_index row,
       const dealii::types::global_dof_index) const
    {
      return operator_diagonal(row);
    }

    /** Without the loops that belong to the space. */
    std::size_t
    memory_consumption() const;

  private:
    template <typename PointModuli>
    void
    pack_moduli(const Space<dim>                    &space,
                const QuadratureField<dim>          &points,
                const PointValues<VoigtMatrix<dim>> &stiffness,
                const double                         unit);

    void
    compute_diagonal(const Space<dim> &space);

    const std::shared_ptr<const CellLoops<dim>> loops;
    const CellKernels<Real>                    &kernels;
    BatchModuli<Real>                           moduli;
    dealii::AlignedVector<Real>                 values_of_moduli;
    std::vector<unsigned int>                   held_rows;
    Vector                                      operator_diagonal;
  };
} // namespace Crevasse

#endif
