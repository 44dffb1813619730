// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_stress_recovery_h
#define crevasse_discretisation_stress_recovery_h

#include <crevasse/discretisation/quadrature_field.h>
#include <crevasse/discretisation/space.h>

#include <deal.II/lac/full_matrix.h>

#include <utility>
#include <vector>

namespace Crevasse
{
  /**
   * Fields at quadrature points seen at nodes: on each cell the polynomial
   * through the values at the points (the nearest one, where there are more),
   * at each node the mean over the cells that meet there, between nodes the
   * shape functions.
   */
  template <int dim>
  class StressRecovery
  {
  public:
    /** A value at one place as a weighted sum over local quadrature points:
     * (offset in the field, weight). */
    using PointWeights = std::vector<std::pair<std::size_t, double>>;

    StressRecovery(const Space<dim> &space, const QuadratureField<dim> &points);

    /** Scalar nodal space that the recovered components live in. */
    const dealii::DoFHandler<dim> &
    dof_handler() const
    {
      return nodal_dofs;
    }

    /** One nodal vector for each stress component, with ghost values set. */
    std::vector<Vector>
    recover(const Vector &field) const;

    /**
     * The recovered value at a point as a sum over the quadrature points near
     * it, so that following a point through time costs next to nothing.
     * Collective; each rank gets the part of its own cells.
     *
     * @param nodal_weights (dof of dof_handler(), weight) of the point in its
     * cell; empty on ranks that do not own the cell.
     */
    PointWeights
    weights_of(
      const std::vector<std::pair<dealii::types::global_dof_index, double>>
        &nodal_weights) const;

    /** Σ weights × field over all ranks. */
    VoigtVector<dim>
    evaluate(const Vector &field, const PointWeights &weights) const;

  private:
    const Space<dim>                 &space;
    const QuadratureField<dim>       &points;
    dealii::DoFHandler<dim>           nodal_dofs;
    dealii::AffineConstraints<double> hanging_nodes;

    /** From the values at the points of a cell to those at its nodes, for each
     * rule. */
    std::vector<dealii::FullMatrix<double>> extrapolations;

    /** 1 / number of cells at each node. */
    Vector inverse_count;
  };
} // namespace Crevasse

#endif
