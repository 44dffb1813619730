// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/cell_polynomials.h>
#include <crevasse/discretisation/stress_recovery.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  StressRecovery<dim>::StressRecovery(const Space<dim>           &space,
                                      const QuadratureField<dim> &points)
    : space(space)
    , points(points)
    , nodal_dofs(space.mesh())
  {
    const FE_Q<dim> fe(space.finite_element().degree);
    nodal_dofs.distribute_dofs(fe);

    extrapolations = fitting_matrices(fe, space);

    IndexSet relevant;
    DoFTools::extract_locally_relevant_dofs(nodal_dofs, relevant);
    hanging_nodes.reinit(relevant);
    DoFTools::make_hanging_node_constraints(nodal_dofs, hanging_nodes);
    hanging_nodes.close();

    inverse_count = make_vector(nodal_dofs);
    std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
    for (const auto &cell : nodal_dofs.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          cell->get_dof_indices(indices);
          for (const auto i : indices)
            inverse_count(i) += 1.;
        }
    inverse_count.compress(VectorOperation::add);
    for (double &count : inverse_count)
      count = 1. / count;
    inverse_count.update_ghost_values();
  }



  template <int dim>
  std::vector<Vector>
  StressRecovery<dim>::recover(const Vector &field) const
  {
    constexpr unsigned int n_components = n_stress_components<dim>;
    std::vector<Vector>    nodal(n_components, make_vector(nodal_dofs));
    std::vector<types::global_dof_index> indices(
      nodal_dofs.get_fe().n_dofs_per_cell());
    for (const auto &cell : nodal_dofs.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const FullMatrix<double> &extrapolation =
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
        component.compress(VectorOperation::add);
        component.scale(inverse_count);
        hanging_nodes.distribute(component);
        component.update_ghost_values();
      }
    return nodal;
  }



  template <int dim>
  typename StressRecovery<dim>::PointWeights
  StressRecovery<dim>::weights_of(
    const std::vector<std::pair<types::global_dof_index, double>>
      &nodal_weights) const
  {
    // The transpose of recover(), applied to the shape functions at the point.
    Vector at_nodes = make_vector(nodal_dofs);
    for (const auto &[dof, weight] : nodal_weights)
      if (const auto *entries = hanging_nodes.get_constraint_entries(dof))
        for (const auto &[parent, factor] : *entries)
          at_nodes(parent) += factor * weight;
      else
        at_nodes(dof) += weight;
    at_nodes.compress(VectorOperation::add);
    at_nodes.scale(inverse_count);
    at_nodes.update_ghost_values();

    PointWeights                         weights;
    std::vector<types::global_dof_index> indices(
      nodal_dofs.get_fe().n_dofs_per_cell());
    for (const auto &cell : nodal_dofs.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const FullMatrix<double> &extrapolation =
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



  template <int dim>
  VoigtVector<dim>
  StressRecovery<dim>::evaluate(const Vector       &field,
                                const PointWeights &weights) const
  {
    VoigtVector<dim> value;
    for (const auto &[offset, weight] : weights)
      value += weight * QuadratureField<dim>::get(field, offset);
    Utilities::MPI::sum(
      ArrayView<const double>(value.begin_raw(), n_stress_components<dim>),
      space.communicator(),
      ArrayView<double>(value.begin_raw(), n_stress_components<dim>));
    return value;
  }



  template class StressRecovery<2>;
  template class StressRecovery<3>;
} // namespace Crevasse
