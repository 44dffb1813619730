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
   * Matrix-free products with A = ∫ DᵀKD, the matrix of assemble_stiffness(),
   * in single or double precision. Rows and columns of constrained unknowns are
   * those of the identity.
   */
  template <int dim, typename Real>
  class StiffnessProduct : public dealii::Subscriptor
  {
  public:
    using Vector = dealii::LinearAlgebra::distributed::Vector<Real>;

    /** Function that works on a range of vector entries. */
    using RangeFunction =
      std::function<void(const unsigned int, const unsigned int)>;

    /** Product for a space without singular functions.
     *
     * @param space Must outlive this object.
     * @param stiffness K at the quadrature points, which is copied.
     * @param unit Unit of K: the product is that of A / unit; in single
     * precision, lengths have the unit of CellLoops::length_unit(). */
    StiffnessProduct(const Space<dim>                    &space,
                     const QuadratureField<dim>          &points,
                     const PointValues<VoigtMatrix<dim>> &stiffness,
                     const double                         unit = 1.);

    void
    initialize(Vector &vector) const
    {
      loops->initialize(vector);
    }

    /** result = A v, with the layout of initialize(). Collective. */
    void
    vmult(Vector &result, const Vector &v) const;

    /** result = A v, calling a function on ranges before and after. */
    void
    vmult(Vector              &result,
          const Vector        &v,
          const RangeFunction &before,
          const RangeFunction &after) const;

    /** Replaces these unconstrained rows and columns by the identity, until the
     * next call, for vectors that are zero there. (The diagonal stays.)
     *
     * @param rows Local indices of locally owned unknowns. */
    void
    hold(const std::vector<unsigned int> &rows)
    {
      held_rows = rows;
    }

    /** Diagonal of A; 1 where constrained. Hanging nodes contribute only the
     * squares of their weights times their diagonal to their masters. */
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

    /** Diagonal entry of this rank, for smoothers. */
    Real
    el(const dealii::types::global_dof_index row,
       const dealii::types::global_dof_index) const
    {
      return operator_diagonal(row);
    }

    /** Bytes on this rank, without the loops, which belong to the space. */
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
