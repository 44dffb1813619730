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
   * Fields at quadrature points seen at nodes: on each cell the polynomial
   * through the values at the points (the nearest one, where there are more),
   * at each node the mean over the cells of one material that meet there,
   * between nodes the shape functions. A node between materials has a value for
   * each of them.
   */
  template <int dim>
  class StressRecovery
  {
  public:
    /** A value at one place as a weighted sum over local quadrature points:
     * (offset in the field, weight). */
    using PointWeights = std::vector<std::pair<std::size_t, double>>;

    /** The first two must outlive this object. Collective.
     * @param materials numbers from 0 on, by active cell index; those of other
     * ranks' cells are not read. Nothing: all is one material. */
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

    /** Scalar nodal space. */
    dealii::DoFHandler<dim> dof_handler;

    /** Between 0 and n_materials - 1 */
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

    /** Calls f(cell of dof_handler, number of a node of it, value there) for
     * the nodes of this rank's cells, in the order of dof_handler's element.
     * Collective. */
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
     * The recovered value at a point as a sum over the quadrature points near
     * it, so that following a point through time costs next to nothing.
     * Collective; each rank gets the part of its own cells.
     *
     * @param nodal_weights (dof of dof_handler, weight) of the point in its
     * cell; empty on ranks that do not own the cell.
     * @param of_cell material of this cell; without meaning on other ranks.
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
      // The transpose of recover(), applied to the shape functions at the
      // point.
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

    /** Σ weights × field of this rank. */
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

    /** f(cell, dofs of its nodes) */
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

    /** 1 / number of cells of a material at each node, 0 without any; with
     * ghost values. */
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

    /** The means over the cells of a material, one vector a component, with
     * ghost values; hanging nodes not yet interpolated. */
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

    /** f(dof, factor) for the nodes that a hanging node lies between, if cells
     * of its material have them all; else for the node itself. */
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

    /** From the values at the points of a cell to those at its nodes, for each
     * rule. */
    std::vector<dealii::FullMatrix<double>> extrapolations;
  };
} // namespace Crevasse

#endif
