// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_field_grid_h
#define crevasse_postprocess_field_grid_h

#include <crevasse/discretisation/stress_recovery.h>
#include <crevasse/postprocess/vtu_file.h>

#include <unordered_map>

namespace Crevasse
{
  /** Grid on which fields are written: a point for each node and each adjacent
   * material, of the cells of this rank, and linear cells between the nodes of
   * a cell. */
  template <int dim>
  class FieldGrid
  {
  public:
    /** @param recovery must outlive the FieldGrid. */
    FieldGrid(const Space<dim> &space, const StressRecovery<dim> &recovery)
      : recovery(recovery)
      , nodes_per_cell(recovery.dof_handler.get_fe().n_dofs_per_cell())
      , points(space.mesh().n_active_cells() * nodes_per_cell)
    {
      const dealii::FiniteElement<dim> &fe  = recovery.dof_handler.get_fe();
      const auto            corners_of_cell = corners_between_nodes(fe.degree);
      dealii::FEValues<dim> nodes(space.mapping,
                                  fe,
                                  dealii::Quadrature<dim>(
                                    fe.get_unit_support_points()),
                                  dealii::update_quadrature_points);
      std::vector<dealii::types::global_dof_index> dofs(nodes_per_cell);
      // Indices of points, by material and degree of freedom.
      std::map<
        unsigned int,
        std::unordered_map<dealii::types::global_dof_index, unsigned int>>
        known;
      for (const auto &cell : owned_cells(recovery.dof_handler))
        {
          nodes.reinit(cell);
          cell->get_dof_indices(dofs);
          auto &of_material = known[recovery.material_of(cell)];
          for (unsigned int i = 0; i < nodes_per_cell; ++i)
            {
              const auto [entry, is_new] =
                of_material.emplace(dofs[i], n_points());
              points[cell->active_cell_index() * nodes_per_cell + i] =
                entry->second;
              if (is_new)
                for (unsigned int d = 0; d < 3; ++d)
                  coordinates.push_back(d < dim ? nodes.quadrature_point(i)[d]
                                                : 0.);
            }
          for (const unsigned int i : corners_of_cell)
            corners.push_back(point(cell, i));
          materials.resize(corners.size() >> dim, cell->material_id());
        }
    }

    std::size_t
    n_points() const
    {
      return coordinates.size() / 3;
    }

    /** Array of values at the nodes, with ghosts.
     * @param n 3: a vector; 1: a scalar on the lip, given in one degree of
     * freedom of each node, with zeros in the others. */
    PointArray
    nodal(const std::string             &name,
          const unsigned int             n,
          const dealii::DoFHandler<dim> &dof_handler,
          const Vector                  &values) const
    {
      const dealii::FiniteElement<dim> &fe = dof_handler.get_fe();
      PointArray array{name, n, std::vector<float>(n * n_points())};
      std::vector<dealii::types::global_dof_index> dofs(fe.n_dofs_per_cell());
      for (const auto &cell : owned_cells(dof_handler))
        {
          cell->get_dof_indices(dofs);
          for (unsigned int i = 0; i < dofs.size(); ++i)
            {
              const auto [component, node] = fe.system_to_component_index(i);
              if (const double value = values(dofs[i]); value != 0.)
                array.values[n * point(cell, node) + component % n] = value;
            }
        }
      return array;
    }

    /** Recovers a field from the quadrature points at the points of the output
     * grid. Collective. */
    std::vector<VoigtVector<dim>>
    recovered(const Vector &field) const
    {
      std::vector<VoigtVector<dim>> values(n_points());
      recovery.recover(field,
                       [&](const auto             &cell,
                           const unsigned int      node,
                           const VoigtVector<dim> &value) {
                         values[point(cell, node)] = value;
                       });
      return values;
    }

    /** Array of n components. @param value function of point and component. */
    template <typename Value>
    PointArray
    array(const std::string &name,
          const unsigned int n,
          const Value       &value) const
    {
      PointArray array{name, n, {}};
      for (std::size_t p = 0; p < n_points(); ++p)
        for (unsigned int c = 0; c < n; ++c)
          array.values.push_back(value(p, c));
      return array;
    }

    /** Array of symmetric tensors at the points. */
    PointArray
    tensor(const std::string                   &name,
           const std::vector<VoigtVector<dim>> &values) const
    {
      // VTK's order is 11, 22, 33, 12, 23, 13; missing components are 0.
      constexpr std::array<unsigned int, 6> component = {{0, 1, 2, 3, 5, 4}};
      return array(name, 6, [&](const std::size_t p, const unsigned int c) {
        return component[c] < n_stress_components<dim> ? values[p][component[c]]
                                                       : 0.;
      });
    }

    VtuGrid
    file() const
    {
      return VtuGrid(coordinates, corners, 1 << dim, materials);
    }

  private:
    /** Nodes of an element at the corners, in VTK's order, of the linear cells
     * between its nodes. */
    static std::vector<unsigned int>
    corners_between_nodes(const unsigned int degree)
    {
      const auto nodes =
        dealii::FETools::lexicographic_to_hierarchic_numbering<dim>(degree);
      const unsigned int        n = degree + 1;
      std::vector<unsigned int> corners;
      for (unsigned int z = 0; z < (dim == 3 ? degree : 1); ++z)
        for (unsigned int y = 0; y < degree; ++y)
          for (unsigned int x = 0; x < degree; ++x)
            for (unsigned int v = 0; v < (1 << dim); ++v)
              {
                const unsigned int vtk = v ^ (v >> 1 & 1); // counter-clockwise
                corners.push_back(
                  nodes[x + (vtk & 1) +
                        n * (y + (vtk >> 1 & 1) + n * (z + (vtk >> 2)))]);
              }
      return corners;
    }

    template <typename Cell>
    unsigned int
    point(const Cell &cell, const unsigned int node) const
    {
      return points[cell->active_cell_index() * nodes_per_cell + node];
    }

    const StressRecovery<dim> &recovery;
    const std::size_t          nodes_per_cell;
    std::vector<unsigned int>  points; ///< point of each node, by cell
    std::vector<float>         coordinates;
    std::vector<std::int32_t>  corners;
    std::vector<std::int32_t>  materials; ///< material ids of linear cells
  };
} // namespace Crevasse

#endif
