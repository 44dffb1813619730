// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_stress_recovery_h
#define crevasse_discretisation_stress_recovery_h

#include <crevasse/discretisation/cell_polynomials.h>

#include <deal.II/fe/fe_q.h>

#include <algorithm>

namespace Crevasse
{
  /**
   * Recovery of fields at quadrature points to nodes: on each cell the
   * polynomial through the values at the points (the nearest one, if there are
   * more), at each node the mean over the cells of one material that meet
   * there, between nodes the shape functions. A node between materials has a
   * value for each material.
   */
  template <int dim>
  class StressRecovery
  {
  public:
    /** Value at a point as a weighted sum over local quadrature points: (offset
     * in the field, weight). */
    using PointWeights = std::vector<std::pair<std::size_t, double>>;

    /** The first two arguments must outlive this object. Collective.
     * @param materials Numbers from 0 on, by active cell index; entries of
     * other ranks' cells are not read. Empty: one material. */
    StressRecovery(const Space<dim>                &space,
                   const QuadratureField<dim>      &points,
                   const std::vector<unsigned int> &materials = {})
      : dof_handler(space.mesh())
      , space(space)
      , points(points)
      , materials(materials)
    {
      const dealii::FE_Q<dim> fe(space.finite_element.degree);
      dof_handler.distribute_dofs(fe);
      extrapolations = fitting_matrices(fe, space);

      const dealii::IndexSet relevant =
        dealii::DoFTools::extract_locally_relevant_dofs(dof_handler);
      layout = std::make_shared<dealii::Utilities::MPI::Partitioner>(
        dof_handler.locally_owned_dofs(), relevant, space.communicator());
      hanging_nodes.reinit(relevant);
      dealii::DoFTools::make_hanging_node_constraints(dof_handler,
                                                      hanging_nodes);
      hanging_nodes.close();

      unsigned int most = 0;
      for (const auto &cell : owned_cells(space.mesh()))
        most = std::max(most, material_of(cell));
      n_materials = 1 + dealii::Utilities::MPI::max(most, space.communicator());
    }

    /** Scalar space of the nodes. */
    dealii::DoFHandler<dim> dof_handler;

    /** Material number of a cell, from 0 to n_materials - 1. */
    unsigned int
    material_of(const typename dealii::Triangulation<dim>::active_cell_iterator
                  &cell) const
    {
      return materials.empty() ? 0 : materials[cell->active_cell_index()];
    }

    bool
    has_interfaces() const
    {
      return n_materials > 1;
    }

    /** Recovers a field: calls f(cell of dof_handler, node of the cell, value)
     * for the nodes of this rank's cells, in the order of dof_handler's
     * element. Collective. */
    template <typename Function>
    void
    recover(const Vector &field, const Function &f) const
    {
      for (unsigned int material = 0; material < n_materials; ++material)
        {
          const Vector              weights = inverse_count(material);
          const std::vector<Vector> nodal   = means(field, material, weights);
          for_each_cell_of(
            material, [&](const auto &cell, const auto &indices) {
              for (unsigned int i = 0; i < indices.size(); ++i)
                {
                  VoigtVector<dim> value;
                  for_each_master(indices[i],
                                  weights,
                                  [&](const auto dof, const double factor) {
                                    for (unsigned int c = 0; c < n_components;
                                         ++c)
                                      value[c] += factor * nodal[c](dof);
                                  });
                  f(cell, i, value);
                }
            });
        }
    }

    /**
     * Recovered value at a point as a sum over the quadrature points near it,
     * so that following a point through time is cheap. Collective; each rank
     * gets the part of its own cells.
     *
     * @param nodal_weights (dof of dof_handler, weight) of the point in its
     * cell; empty on ranks that do not own the cell.
     * @param of_cell Material of this cell; without meaning on other ranks.
     */
    PointWeights
    weights_of(
      const std::vector<std::pair<dealii::types::global_dof_index, double>>
                        &nodal_weights,
      const unsigned int of_cell) const
    {
      const unsigned int material =
        dealii::Utilities::MPI::max(nodal_weights.empty() ? 0 : of_cell,
                                    space.communicator());
      // Apply the transpose of recover() to the shape functions at the point.
      const Vector weights_of_cells = inverse_count(material);
      Vector       at_nodes(layout);
      for (const auto &[dof, weight] : nodal_weights)
        for_each_master(dof,
                        weights_of_cells,
                        [&at_nodes, of_node = weight](const auto   master,
                                                      const double factor) {
                          at_nodes(master) += factor * of_node;
                        });
      at_nodes.compress(dealii::VectorOperation::add);
      at_nodes.scale(weights_of_cells);
      at_nodes.update_ghost_values();

      PointWeights weights;
      for_each_cell_of(material, [&](const auto &cell, const auto &indices) {
        if (std::all_of(indices.begin(), indices.end(), [&](const auto i) {
              return at_nodes(i) == 0.;
            }))
          return;
        const auto &extrapolation = extrapolations[space.rule(cell)];
        for (unsigned int q = 0; q < extrapolation.n(); ++q)
          {
            double weight = 0.;
            for (unsigned int i = 0; i < extrapolation.m(); ++i)
              weight += extrapolation(i, q) * at_nodes(indices[i]);
            if (weight != 0.)
              weights.emplace_back(points.offset(cell) + q * n_components,
                                   weight);
          }
      });
      return weights;
    }

    /** Sum Σ weights × field on this rank. */
    static VoigtVector<dim>
    evaluate(const Vector &field, const PointWeights &weights)
    {
      VoigtVector<dim> value;
      for (const auto &[offset, weight] : weights)
        value += weight * QuadratureField<dim>::get(field, offset);
      return value;
    }

  private:
    static constexpr unsigned int n_components = n_stress_components<dim>;

    /** Calls f(cell, dofs of its nodes) for each cell of a material. */
    template <typename Function>
    void
    for_each_cell_of(const unsigned int material, const Function &f) const
    {
      std::vector<dealii::types::global_dof_index> indices(
        dof_handler.get_fe().n_dofs_per_cell());
      for (const auto &cell : owned_cells(dof_handler))
        if (material_of(cell) == material)
          {
            cell->get_dof_indices(indices);
            f(cell, indices);
          }
    }

    /** Inverse of the number of cells of a material at each node, 0 without
     * any; with ghost values. */
    Vector
    inverse_count(const unsigned int material) const
    {
      Vector inverse(layout);
      for_each_cell_of(material, [&](const auto &, const auto &indices) {
        for (const auto i : indices)
          inverse(i) += 1.;
      });
      inverse.compress(dealii::VectorOperation::add);
      for (double &count : inverse)
        count = count > 0. ? 1. / count : 0.;
      inverse.update_ghost_values();
      return inverse;
    }

    /** Means over the cells of a material at nodes, one vector a component,
     * with ghost values; hanging nodes are not interpolated yet. */
    std::vector<Vector>
    means(const Vector      &field,
          const unsigned int material,
          const Vector      &weights) const
    {
      std::vector<Vector> nodal(n_components, Vector(layout));
      for_each_cell_of(material, [&](const auto &cell, const auto &indices) {
        const auto       &extrapolation = extrapolations[space.rule(cell)];
        const std::size_t offset        = points.offset(cell);
        for (unsigned int i = 0; i < extrapolation.m(); ++i)
          {
            VoigtVector<dim> value;
            for (unsigned int q = 0; q < extrapolation.n(); ++q)
              value +=
                extrapolation(i, q) *
                QuadratureField<dim>::get(field, offset + q * n_components);
            for (unsigned int c = 0; c < n_components; ++c)
              nodal[c](indices[i]) += value[c];
          }
      });
      for (Vector &component : nodal)
        {
          component.compress(dealii::VectorOperation::add);
          component.scale(weights);
          component.update_ghost_values();
        }
      return nodal;
    }

    /** Calls f(dof, factor) for the masters of a hanging node, if cells of its
     * material have all of them; else for the node itself. */
    template <typename Function>
    void
    for_each_master(const dealii::types::global_dof_index dof,
                    const Vector                         &inverse_count,
                    const Function                       &f) const
    {
      if (const auto *masters = hanging_nodes.get_constraint_entries(dof);
          masters != nullptr &&
          std::all_of(masters->begin(), masters->end(), [&](const auto &entry) {
            return inverse_count(entry.first) > 0.;
          }))
        for (const auto &[master, factor] : *masters)
          f(master, factor);
      else
        f(dof, 1.);
    }

    const Space<dim>                                          &space;
    const QuadratureField<dim>                                &points;
    const std::vector<unsigned int>                            materials;
    unsigned int                                               n_materials;
    dealii::AffineConstraints<double>                          hanging_nodes;
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;

    /** Matrices from values at the points of a cell to values at its nodes, for
     * each rule. */
    std::vector<dealii::FullMatrix<double>> extrapolations;
  };
} // namespace Crevasse

#endif
