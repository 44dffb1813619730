// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/postprocess/field_grid.h>

#include <unordered_map>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** The nodes of an element that are the corners, in VTK's order, of the
     * linear cells between its nodes. */
    template <int dim>
    std::vector<unsigned int>
    corners_between_nodes(const unsigned int degree)
    {
      const auto nodes =
        FETools::lexicographic_to_hierarchic_numbering<dim>(degree);
      const unsigned int        n = degree + 1;
      std::vector<unsigned int> corners;
      for (unsigned int z = 0; z < (dim == 3 ? degree : 1); ++z)
        for (unsigned int y = 0; y < degree; ++y)
          for (unsigned int x = 0; x < degree; ++x)
            for (unsigned int v = 0; v < (1 << dim); ++v)
              {
                const unsigned int vtk = v ^ (v >> 1 & 1); // goes round
                corners.push_back(
                  nodes[x + (vtk & 1) +
                        n * (y + (vtk >> 1 & 1) + n * (z + (vtk >> 2)))]);
              }
      return corners;
    }
  } // namespace



  template <int dim>
  FieldGrid<dim>::FieldGrid(const Space<dim>          &space,
                            const StressRecovery<dim> &recovery)
    : recovery(recovery)
    , nodes_per_cell(recovery.dof_handler.get_fe().n_dofs_per_cell())
    , points(space.mesh().n_active_cells() * nodes_per_cell)
  {
    const FiniteElement<dim> &fe  = recovery.dof_handler.get_fe();
    const auto    corners_of_cell = corners_between_nodes<dim>(fe.degree);
    FEValues<dim> nodes(space.mapping,
                        fe,
                        Quadrature<dim>(fe.get_unit_support_points()),
                        update_quadrature_points);
    std::vector<types::global_dof_index> dofs(nodes_per_cell);
    // The points by material and dof.
    std::map<unsigned int,
             std::unordered_map<types::global_dof_index, unsigned int>>
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
      }
  }



  template <int dim>
  PointArray
  FieldGrid<dim>::nodal(const std::string     &name,
                        const DoFHandler<dim> &dof_handler,
                        const Vector          &values) const
  {
    const FiniteElement<dim> &fe = dof_handler.get_fe();
    const unsigned int        n  = fe.n_components() == 1 ? 1 : 3;
    PointArray array{name, n, std::vector<float>(n * n_points())};
    std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
    for (const auto &cell : owned_cells(dof_handler))
      {
        cell->get_dof_indices(dofs);
        for (unsigned int i = 0; i < dofs.size(); ++i)
          {
            const auto [component, node] = fe.system_to_component_index(i);
            array.values[n * point(cell, node) + component] = values(dofs[i]);
          }
      }
    return array;
  }



  template <int dim>
  std::vector<VoigtVector<dim>>
  FieldGrid<dim>::recovered(const Vector &field) const
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



  template class FieldGrid<2>;
  template class FieldGrid<3>;
} // namespace Crevasse
