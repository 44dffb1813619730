// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_stress_recovery_h
#define crevasse_discretisation_stress_recovery_h

#include <crevasse/discretisation/cell_polynomials.h>
#include <crevasse/discretisation/quadrature_field.h>
#include <crevasse/discretisation/space.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
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

    StressRecovery(const Space<dim> &space, const QuadratureField<dim> &points)
      : space(space)
      , points(points)
      , nodal_dofs(space.mesh())
    {
      const dealii::FE_Q<dim> fe(space.finite_element().degree);
      nodal_dofs.distribute_dofs(fe);

      extrapolations = fitting_matrices(fe, space);

      dealii::IndexSet relevant;
      dealii::DoFTools::extract_locally_relevant_dofs(nodal_dofs, relevant);
      hanging_nodes.reinit(relevant);
      dealii::DoFTools::make_hanging_node_constraints(nodal_dofs,
                                                      hanging_nodes);
      hanging_nodes.close();

      inverse_count = make_vector(nodal_dofs);
      std::vector<dealii::types::global_dof_index> indices(
        fe.n_dofs_per_cell());
      for (const auto &cell : owned_cells(nodal_dofs))
        {
          cell->get_dof_indices(indices);
          for (const auto i : indices)
            inverse_count(i) += 1.;
        }
      inverse_count.compress(dealii::VectorOperation::add);
      for (double &count : inverse_count)
        count = 1. / count;
      inverse_count.update_ghost_values();
    }

    /** Scalar nodal space that the recovered components live in. */
    const dealii::DoFHandler<dim> &
    dof_handler() const
    {
      return nodal_dofs;
    }

    /** One nodal vector for each stress component, with ghost values set. */
    std::vector<Vector>
    recover(const Vector &field) const
    {
      constexpr unsigned int n_components = n_stress_components<dim>;
      std::vector<Vector>    nodal(n_components, make_vector(nodal_dofs));
      std::vector<dealii::types::global_dof_index> indices(
        nodal_dofs.get_fe().n_dofs_per_cell());
      for (const auto &cell : owned_cells(nodal_dofs))
        {
          const dealii::FullMatrix<double> &extrapolation =
            extrapolations[space.rule(cell)];
          cell->get_dof_indices(indices);
          const std::size_t offset = points.offset(cell);
          for (unsigned int i = 0; i < extrapolation.m(); ++i)
            for (unsigned int q = 0; q < extrapolation.n(); ++q)
              for (unsigned int c = 0; c < n_components; ++c)
                nodal[c](indices[i]) +=
                  extrapolation(i, q) *
                  field.local_element(offset + q * n_components + c);
        }
      for (Vector &component : nodal)
        {
          component.compress(dealii::VectorOperation::add);
          component.scale(inverse_count);
          hanging_nodes.distribute(component);
          component.update_ghost_values();
        }
      return nodal;
    }

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
        &nodal_weights) const
    {
      // The transpose of recover(), applied to the shape functions at the
      // point.
      Vector at_nodes = make_vector(nodal_dofs);
      for (const auto &[dof, weight] : nodal_weights)
        if (const auto *entries = hanging_nodes.get_constraint_entries(dof))
          for (const auto &[parent, factor] : *entries)
            at_nodes(parent) += factor * weight;
        else
          at_nodes(dof) += weight;
      at_nodes.compress(dealii::VectorOperation::add);
      at_nodes.scale(inverse_count);
      at_nodes.update_ghost_values();

      PointWeights                                 weights;
      std::vector<dealii::types::global_dof_index> indices(
        nodal_dofs.get_fe().n_dofs_per_cell());
      for (const auto &cell : owned_cells(nodal_dofs))
        {
          const dealii::FullMatrix<double> &extrapolation =
            extrapolations[space.rule(cell)];
          cell->get_dof_indices(indices);
          for (unsigned int q = 0; q < extrapolation.n(); ++q)
            {
              double weight = 0.;
              for (unsigned int i = 0; i < extrapolation.m(); ++i)
                weight += extrapolation(i, q) * at_nodes(indices[i]);
              if (weight != 0.)
                weights.emplace_back(points.offset(cell) +
                                       q * n_stress_components<dim>,
                                     weight);
            }
        }
      return weights;
    }

    /** Σ weights × field over all ranks. */
    VoigtVector<dim>
    evaluate(const Vector &field, const PointWeights &weights) const
    {
      VoigtVector<dim> value;
      for (const auto &[offset, weight] : weights)
        value += weight * QuadratureField<dim>::get(field, offset);
      dealii::Utilities::MPI::sum(
        dealii::ArrayView<const double>(value.begin_raw(),
                                        n_stress_components<dim>),
        space.communicator(),
        dealii::ArrayView<double>(value.begin_raw(), n_stress_components<dim>));
      return value;
    }

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
